#include <gtest/gtest.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "evaluation/map_evaluation.hpp"
#include "laneloom/mapper.hpp"
#include "simulation/motorways.hpp"
#include "simulation/perception.hpp"
#include "simulation/road_builder.hpp"

/// Perfect detections: which way the traffic runs is said where it can be told, and hardly ever wrong.
namespace laneloom {
namespace {

constexpr double kSpeed_mps = 15.0;
constexpr double kMinPrecision = 0.995;
constexpr double kMinRecall = 0.85;

struct Drive {
  std::string name;
  simulation::Road road;
  double min_recall;
};

void PrintTo(const Drive& drive, std::ostream* out) { *out << drive.name; }

/// How often a lane's direction was known, and then is not.
class Forgotten {
 public:
  void add(const LocalMap& map) {
    std::map<ElementId, bool> now;
    for (const Lane& lane : map.lanes) {
      const bool known = lane.direction != Lane::Direction::unknown;
      const auto before = known_.find(lane.id);
      if (before != known_.end() && before->second && !known) ++count_;
      now.emplace(lane.id, known);
    }
    known_ = std::move(now);
  }
  int count() const { return count_; }

 private:
  std::map<ElementId, bool> known_;
  int count_ = 0;
};

class Directions : public ::testing::TestWithParam<Drive> {};

TEST_P(Directions, AreToldAndRightAndStayKnown) {
  const simulation::Road& road = GetParam().road;
  MapperConfig config;
  config.direction.driving_side = road.right_hand_traffic ? DrivingSide::right : DrivingSide::left;
  Mapper mapper(config);
  simulation::Perception perception(road, simulation::noise_profile("none"), simulation::SensorView{}, 1);
  evaluation::MapEvaluation evaluation(road, config.range, evaluation::Subject::maps);
  Forgotten forgotten;
  for (int i = 1; i < static_cast<int>(road.drive.duration_s() * 10.0); ++i) {
    const VehiclePose pose = road.drive.pose_at(0.1 * i);
    const LocalMap& map = mapper.update(perception.observe(pose), transform(pose));
    evaluation.add(map);
    forgotten.add(map);
  }
  const evaluation::PairScore& directions = evaluation.topology().directions;
  EXPECT_GE(directions.precision(), kMinPrecision);
  EXPECT_GE(directions.recall(), GetParam().min_recall);
  EXPECT_LE(forgotten.count(), 1);
}

simulation::Road street(int forward, int backward, simulation::CentreLine centre, int solid_after,
                        int driven) {
  const simulation::Alignment way({}, {simulation::straight(200.0)});
  simulation::Section section = two_way(forward, backward, centre);
  section.solid_after = solid_after;
  simulation::RoadBuilder builder("street");
  builder.add_street(way, section);
  return std::move(builder).build({way.point(10.0, -3.5 * (driven - 0.5))}, kSpeed_mps);
}

/// The lanes beyond a wide median are out of range from the outer lane.
std::vector<Drive> medians() {
  std::vector<Drive> drives;
  for (const double median_m : {0.3, 1.0, 3.0, 6.5, 15.0}) {
    for (const bool kerbs : {false, true}) {
      for (const int driven : {1, 2}) {
        const std::string name = "median_" + std::to_string(static_cast<int>(10.0 * median_m)) + "_dm" +
                                 (kerbs ? "_kerbs" : "_lines") + (driven == 1 ? "_inside" : "_outside");
        const simulation::DividedRoad divided{
            .median_m = median_m, .kerbs = kerbs, .curved = kerbs, .driven = driven};
        drives.push_back({name, simulation::divided_road(divided, kSpeed_mps),
                          median_m > 10.0 && driven == 2 ? 0.45 : kMinRecall});
      }
    }
  }
  return drives;
}

/// The direction beyond a line may be either where the road is seen from one side of it alone.
std::vector<Drive> roads() {
  using enum simulation::CentreLine;
  std::vector<Drive> drives = medians();
  const std::vector<Drive> others{
      {"alone_inside", simulation::divided_road({.oncoming = false, .driven = 1}, kSpeed_mps), kMinRecall},
      {"alone_outside", simulation::divided_road({.oncoming = false, .driven = 2}, kSpeed_mps), 0.45},
      {"wide_road", street(2, 2, double_solid, 0, 1), kMinRecall},
      {"wide_road_with_one_line", street(2, 2, solid, 0, 2), kMinRecall},
      {"bus_lane_on_the_right", street(2, 2, dashed, 1, 1), 0.45},
      {"in_bus_lane_on_the_right", street(2, 2, dashed, 1, 2), 0.2},
      {"bus_lanes_outside", street(3, 3, double_solid, 2, 1), kMinRecall},
      {"bus_lanes_inside", street(3, 3, double_solid, 1, 2), kMinRecall},
      {"in_bus_lane_inside", street(3, 3, solid, 1, 1), 0.6},
      {"reversible_lane", street(2, 1, dashed, 0, 1), 0.6},
      {"beside_reversible_lane", street(2, 1, dashed, 0, 2), 0.3},
      {"beside_oncoming_reversible_lane", street(1, 2, dashed, 0, 1), 0.3},
      {"exit", simulation::exit_road(kSpeed_mps), 0.45},
      {"exit_taken", simulation::exit_road(kSpeed_mps, {.driven = true}), 0.45},
      {"entry", simulation::entry_road(kSpeed_mps), 0.38},
      {"entry_taken", simulation::entry_road(kSpeed_mps, {.driven = true}), 0.3}};
  drives.insert(drives.end(), others.begin(), others.end());
  for (std::size_t i = 0, right = drives.size(); i < right; i += 3)
    drives.push_back(
        {drives[i].name + "_in_left_hand_traffic", mirrored(drives[i].road), drives[i].min_recall});
  return drives;
}

INSTANTIATE_TEST_SUITE_P(Roads, Directions, ::testing::ValuesIn(roads()),
                         [](const auto& drive) { return drive.param.name; });

}  // namespace
}  // namespace laneloom
