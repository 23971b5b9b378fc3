#include "bench/worst_frames.hpp"

#include <chrono>
#include <cmath>
#include <cstddef>
#include <vector>

#include "session/mapping_session.hpp"
#include "support/stage_timer.hpp"

namespace laneloom::bench {
namespace {

constexpr std::size_t kDetections = 512;  // as many as a message may have
constexpr std::size_t kPoints = 64;
constexpr double kPi = 3.14159265358979;
constexpr std::int64_t kPosePeriod_ns = 20'000'000;
constexpr std::int64_t kFramePeriod_ns = 100'000'000;
constexpr double kSpeed_mps = 10.0;

/// Points of a curve at equal steps of its parameter, 0 to 1.
template <class Curve>
Polyline sampled(Curve curve) {
  Polyline points;
  for (std::size_t i = 0; i < kPoints; ++i) points.push_back(curve(static_cast<double>(i) / (kPoints - 1)));
  return points;
}

Polyline straight(const Point& from, const Point& to) {
  return sampled([&](double t) { return Point(from + t * (to - from)); });
}

Polyline spiral(const Point& center, double from_m, double turns) {
  return sampled([&](double t) {
    const double angle = 2.0 * kPi * turns * t, radius = from_m + 3.0 * t;
    return Point(center + radius * Point(std::cos(angle), std::sin(angle), 0.0));
  });
}

Polyline ring(const Point& center, double radius_m) {
  return sampled([&](double t) {
    return Point(center + radius_m * Point(std::cos(2.0 * kPi * t), std::sin(2.0 * kPi * t), 0.0));
  });
}

/// A number in 0..1 that differs from index to index without a visible order.
double scattered(std::size_t index) { return std::fmod(0.618033988749895 * static_cast<double>(index), 1.0); }

Polyline line(WorstKind kind, std::size_t index, std::uint64_t number) {
  const double share = static_cast<double>(index) / kDetections;
  const double across_m = -15.0 + 30.0 * share;
  switch (kind) {
    case WorstKind::parallel:
      return straight({-5, across_m, 0}, {30, across_m, 0});
    case WorstKind::crossing:
      return index % 2 == 0 ? straight({-5, across_m, 0}, {30, across_m, 0})
                            : straight({-5 + 35 * share, -15, 0}, {-5 + 35 * share, 15, 0});
    case WorstKind::spiralling:
      return spiral({12.0, 0.0, 0.0}, 12.0 * scattered(index), 2.0);
    case WorstKind::closed:
      return ring({-5 + 35 * scattered(index), -15 + 30 * scattered(3 * index), 0}, 1.0 + 3.0 * share);
    case WorstKind::doubled: {
      const double beside_m =
          -15.0 + 0.5 * static_cast<double>(index / 2 % 60) + (index % 2 == 0 ? 0.0 : 0.15);
      return straight({-5, beside_m, 0}, {30, beside_m, 0});
    }
    case WorstKind::heap:
      return straight({10, 0.001 * static_cast<double>(index), 0}, {14, 0.5 * scattered(index), 0});
    case WorstKind::changing: {
      const double angle = 2.0 * kPi * scattered(index + 7 * number);
      const Point from(-5 + 35 * scattered(index + 13 * number), -15 + 30 * scattered(5 * index + number), 0);
      return straight(from, from + 4.0 * Point(std::cos(angle), std::sin(angle), 0.0));
    }
  }
  return {};
}

VehiclePose pose_at(std::int64_t stamp_ns) {
  const double x_m = kSpeed_mps * static_cast<double>(stamp_ns) / 1e9;
  return {.stamp_ns = stamp_ns, .session_id = 1, .position = {x_m, 0.0, 0.0}};
}

double milliseconds_of(const auto& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

const char* name(WorstKind kind) {
  static constexpr std::array<const char*, kWorstKinds.size()> kNames{
      "parallel", "crossing", "spiralling", "closed", "doubled", "heap", "changing"};
  return kNames.at(static_cast<std::size_t>(kind));
}

DetectionFrame worst_frame(WorstKind kind, std::uint64_t number) {
  DetectionFrame frame{.sequence = number, .session_id = 1};
  frame.detections.resize(kDetections);
  for (std::size_t i = 0; i < kDetections; ++i) {
    Detection& detection = frame.detections[i];
    if (kind == WorstKind::heap) detection.type = kMarkingTypes[i % kMarkingTypeCount];
    detection.confidence = 0.9;
    detection.points = line(kind, i, number);
  }
  return frame;
}

TimeSummary time_worst(const Config& config, WorstKind kind, std::uint64_t frames) {
  session::MappingSession session(config);
  std::vector<double> times_ms;
  for (std::uint64_t number = 1; number <= frames; ++number) {
    const std::int64_t stamp_ns = kFramePeriod_ns * static_cast<std::int64_t>(number);
    for (std::int64_t t = stamp_ns - kFramePeriod_ns + kPosePeriod_ns; t <= stamp_ns; t += kPosePeriod_ns)
      session.add(pose_at(t));
    DetectionFrame frame = worst_frame(kind, number);
    frame.stamp_ns = stamp_ns;
    times_ms.push_back(milliseconds_of([&] { session.add(std::move(frame), stamp_ns); }));
  }
  return support::summarise(std::move(times_ms));
}

}  // namespace laneloom::bench
