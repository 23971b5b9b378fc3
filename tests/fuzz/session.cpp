#include <algorithm>
#include <cstring>

#include "memory_file.hpp"
#include "session/mapping_session.hpp"

namespace {

using namespace laneloom;

/// Takes values out of the input; zeros when it is used up.
class Values {
 public:
  Values(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  bool empty() const { return size_ == 0; }

  template <class T>
  T next() {
    T value{};
    const std::size_t count = std::min(sizeof(T), size_);
    std::memcpy(&value, data_, count);
    data_ += count;
    size_ -= count;
    return value;
  }
  /// Mostly of a road's scale, sometimes anything.
  double number() {
    const auto kind = next<std::uint8_t>();
    if (kind < 8) return next<double>();
    return 0.01 * static_cast<double>(next<std::int16_t>());
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
};

Point point(Values& values) { return {values.number(), values.number(), 0.01 * values.number()}; }

Polyline polyline(Values& values) {
  Polyline points(values.next<std::uint8_t>() % 24);
  for (Point& p : points) p = point(values);
  return points;
}

DetectionFrame frame(Values& values, std::int64_t stamp_ns) {
  DetectionFrame result{.stamp_ns = stamp_ns, .session_id = values.next<std::uint8_t>() % 2U};
  if (values.next<std::uint8_t>() % 4 == 0) result.field_of_view = polyline(values);
  if (values.next<std::uint8_t>() % 4 == 0) result.occluded_areas.push_back(polyline(values));
  const int count = values.next<std::uint8_t>() % 12;
  for (int i = 0; i < count; ++i) {
    Detection detection{.type = static_cast<MarkingType>(values.next<std::uint8_t>() % 3),
                        .confidence = static_cast<double>(values.next<std::uint8_t>()) / 255.0,
                        .points = polyline(values)};
    if (values.next<std::uint8_t>() % 4 == 0)
      for (std::size_t k = 0; k < detection.points.size(); ++k) detection.stddev_m.push_back(values.number());
    result.detections.push_back(detection);
  }
  return result;
}

}  // namespace

/// Sequences of hostile frames and poses into the mapper. The first byte tells the method.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Values values(data, size);
  Config config;
  config.mapper.method = values.next<std::uint8_t>() % 2 == 0 ? FusionMethod::lines : FusionMethod::voxels;
  config.mapper.voxel_map.min_detections = 1;
  session::MappingSession session(config);
  std::int64_t stamp_ns = 1'000'000'000;
  for (int i = 0; i < 64 && !values.empty(); ++i) {
    const auto step = values.next<std::uint8_t>();
    stamp_ns = step < 4 ? values.next<std::int64_t>() / 4 : stamp_ns + 100'000'000;
    const Point position(values.number(), values.number(), 0.0);
    session.add(VehiclePose{.stamp_ns = stamp_ns, .position = position});
    if (values.next<std::uint8_t>() % 4 == 0)
      session.add(NextTurn{.stamp_ns = stamp_ns,
                           .turn = static_cast<Linkage::Turn>(values.next<std::uint8_t>() % 5),
                           .distance_m = values.number()});
    session.add(frame(values, stamp_ns), stamp_ns);
    session.expire(stamp_ns);
    for (const Marking& marking : session.map().boundaries) {
      if (marking.points.size() < 2) __builtin_trap();
      for (const Point& p : marking.points)
        if (!p.allFinite()) __builtin_trap();
    }
  }
  return 0;
}
