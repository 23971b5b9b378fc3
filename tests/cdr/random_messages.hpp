#pragma once

#include <random>
#include <string>
#include <vector>

#include "cdr/layout.hpp"

/// Messages with every field set, at random, for tests of conversion and serialisation.
namespace laneloom::dds {

class RandomMessages {
 public:
  explicit RandomMessages(unsigned seed) : engine_(seed) {}

  msg::Detections detections();
  msg::VehiclePose vehicle_pose();
  msg::Objects objects();
  msg::NextTurn next_turn();
  msg::LaneMap lane_map();
  msg::RoadMarkings road_markings();
  msg::ServiceStatus service_status();

  // Typed tests choose the message by its type.
  void fill(msg::Detections& m) { m = detections(); }
  void fill(msg::VehiclePose& m) { m = vehicle_pose(); }
  void fill(msg::Objects& m) { m = objects(); }
  void fill(msg::NextTurn& m) { m = next_turn(); }
  void fill(msg::LaneMap& m) { m = lane_map(); }
  void fill(msg::RoadMarkings& m) { m = road_markings(); }
  void fill(msg::ServiceStatus& m) { m = service_status(); }

 private:
  std::uint64_t whole(std::uint64_t max) {
    return std::uniform_int_distribution<std::uint64_t>(0, max)(engine_);
  }
  std::uint64_t id() { return engine_(); }
  std::int64_t stamp() { return static_cast<std::int64_t>(whole(1ULL << 60)); }
  double number() { return std::uniform_real_distribution<double>(-1000.0, 1000.0)(engine_); }
  /// An age that nanoseconds represent exactly.
  double age() { return static_cast<double>(whole(1'000'000'000'000)) / 1e9; }
  template <class Enum>
  Enum one_of(Enum last) {
    return static_cast<Enum>(whole(static_cast<std::uint64_t>(last)));
  }
  template <class Make>
  auto several(std::size_t at_most, Make make) {
    std::vector<decltype(make())> list(1 + whole(at_most - 1));
    for (auto& element : list) element = make();
    return list;
  }
  std::vector<double> numbers(std::size_t count);
  std::string text(const char* prefix) { return prefix + std::to_string(whole(1000)); }

  msg::Point point();
  msg::Polyline polyline() {
    return several(12, [&] { return point(); });
  }
  msg::Range range();
  msg::Pose pose();
  msg::Header header();
  msg::Marking marking();
  msg::Neighbour neighbour();
  std::uint32_t evidence() { return static_cast<std::uint32_t>(whole(31)); }
  msg::Border border();
  msg::Lane lane();
  msg::Stopline stopline();
  msg::Linkage linkage();
  msg::WayStation way_station();
  msg::Way way();

  std::mt19937_64 engine_;
};

}  // namespace laneloom::dds
