#include <algorithm>
#include <cmath>
#include <limits>

#include "cdr/fast_cdr.hpp"
#include "scene/foxglove.hpp"

namespace laneloom::scene::foxglove {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::uint32_t kMatchingId = 0;
constexpr std::uint32_t kNone = 0;  ///< the length of a list that is not used here

/// Writes values one after the other, in the order of the IDL.
class Writer {
 public:
  Writer() : cdr_(buffer_, eprosima::fastcdr::Cdr::LITTLE_ENDIANNESS, eprosima::fastcdr::CdrVersion::XCDRv1) {
    cdr_.serialize_encapsulation();
  }

  template <class Value>
  void put(const Value& value) {
    cdr_ << value;
  }
  void put(const Point& point) { cdr_ << point.x() << point.y() << point.z(); }
  void put(const Eigen::Quaterniond& q) { cdr_ << q.x() << q.y() << q.z() << q.w(); }
  void put(const drawing::Colour& colour) {
    cdr_ << colour.red << colour.green << colour.blue << colour.alpha;
  }
  void put_pose(const Point& position) {
    put(position);
    put(Eigen::Quaterniond::Identity());
  }
  void put_time(std::int64_t time_ns) {
    const std::int64_t end_ns = (std::int64_t{std::numeric_limits<std::uint32_t>::max()} + 1) * kSecond_ns;
    const std::int64_t within_ns = std::clamp(time_ns, std::int64_t{0}, end_ns - 1);
    cdr_ << static_cast<std::uint32_t>(within_ns / kSecond_ns)
         << static_cast<std::uint32_t>(within_ns % kSecond_ns);
  }
  void put_duration(double duration_s) {
    const auto whole_s = static_cast<std::int32_t>(duration_s);
    cdr_ << whole_s << static_cast<std::uint32_t>((duration_s - whole_s) * kSecond_ns);
  }
  /// Writes a list. Each item is written by `write(item)`.
  template <class Item, class Write>
  void put_list(const std::vector<Item>& items, Write write) {
    cdr_ << static_cast<std::uint32_t>(items.size());
    for (const Item& item : items) write(item);
  }
  void put_points(const Polyline& points) {
    put_list(points, [this](const Point& point) { put(point); });
  }

  std::vector<std::uint8_t> bytes() {
    const auto* begin = reinterpret_cast<const std::uint8_t*>(buffer_.getBuffer());
    return {begin, begin + dds::written_bytes(cdr_)};
  }

 private:
  eprosima::fastcdr::FastBuffer buffer_;  // grows
  eprosima::fastcdr::Cdr cdr_;
};

void put(const LinePrimitive& line, Writer& to) {
  to.put(static_cast<std::uint32_t>(line.type));
  to.put_pose(line.origin);
  to.put(line.thickness_px);
  to.put(true);  // its thickness is in pixels
  to.put_points(line.points);
  to.put(line.colour);
  to.put(kNone);  // colours of points
  to.put(kNone);  // indices
}

void put(const TrianglePrimitive& triangles, Writer& to) {
  to.put_pose(triangles.origin);
  to.put_points(triangles.points);
  to.put(triangles.colour);
  to.put(kNone);  // colours of points
  to.put_list(triangles.indices, [&](std::uint32_t index) { to.put(index); });
}

void put(const TextPrimitive& text, Writer& to) {
  to.put_pose(text.position);
  to.put(true);  // faces the camera
  to.put(text.height_px);
  to.put(true);  // its height is in pixels
  to.put(text.colour);
  to.put(text.text);
}

void put(const SceneEntity& entity, const SceneUpdate& update, Writer& to) {
  to.put_time(update.time_ns);
  to.put(entity.frame_id);
  to.put(entity.id);
  to.put_duration(update.lifetime_s);
  to.put(entity.frame_locked);
  to.put_list(entity.metadata, [&](const auto& pair) {
    to.put(pair.first);
    to.put(pair.second);
  });
  for (int unused = 0; unused < 4; ++unused) to.put(kNone);  // arrows, cubes, spheres, cylinders
  to.put_list(entity.lines, [&](const LinePrimitive& line) { foxglove::put(line, to); });
  to.put_list(entity.triangles, [&](const TrianglePrimitive& triangles) { foxglove::put(triangles, to); });
  to.put_list(entity.texts, [&](const TextPrimitive& text) { foxglove::put(text, to); });
  to.put(kNone);  // models
}

}  // namespace

std::vector<std::uint8_t> to_cdr(const SceneUpdate& update) {
  Writer to;
  to.put_list(update.deleted, [&](const std::string& id) {
    to.put_time(update.time_ns);
    to.put(kMatchingId);
    to.put(id);
  });
  to.put_list(update.entities, [&](const SceneEntity& entity) { put(entity, update, to); });
  return to.bytes();
}

std::vector<std::uint8_t> to_cdr(const FrameTransform& transform) {
  Writer to;
  to.put_time(transform.time_ns);
  to.put(transform.parent);
  to.put(transform.child);
  to.put(Point(transform.T_parent_child.translation()));
  to.put(Eigen::Quaterniond(transform.T_parent_child.rotation()));
  return to.bytes();
}

}  // namespace laneloom::scene::foxglove
