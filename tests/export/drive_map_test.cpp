#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "drives.hpp"
#include "evaluation/map_evaluation.hpp"
#include "export/weave.hpp"
#include "laneloom/polyline.hpp"

namespace laneloom::exports {
namespace {

constexpr std::size_t kFirst = 20;  // before it, the local map has seen little
constexpr std::size_t kStep = 5;

/// Whether the vehicle drove in a lane for half a second.
bool is_driven(const simulation::RoadLane& lane, const simulation::Drive& drive) {
  const MeasuredPolyline line(lane.centerline);
  int inside = 0;
  for (const VehiclePose& pose : drive.poses()) {
    const Projection foot = line.project(pose.position, 1.0);
    const Eigen::Vector2d heading = transform(pose).linear().col(0).head<2>();
    if (foot.inside && foot.distance_m < 1.0 && line.direction(foot).dot(heading) > 0.7) ++inside;
  }
  return inside >= 5;
}

/// The share of a lane's length that lies on lanes of the map: less than 0.5 m beside, and as they run.
double covered_share(const simulation::RoadLane& lane, const std::vector<MeasuredPolyline>& lanes) {
  const MeasuredPolyline truth(lane.centerline);
  const Polyline samples = truth.resample(0.5);
  const auto is_covered = [&](const Point& sample) {
    const Eigen::Vector2d along = truth.direction(truth.project(sample));
    return std::ranges::any_of(lanes, [&](const MeasuredPolyline& line) {
      const Projection foot = line.project(sample, 0.5);
      return foot.inside && foot.distance_m < 0.5 && line.direction(foot).dot(along) > 0.9;
    });
  };
  return static_cast<double>(std::ranges::count_if(samples, is_covered)) /
         static_cast<double>(samples.size());
}

void print(const char* what, const evaluation::MapEvaluation& evaluation) {
  const evaluation::Score markings = evaluation.score().markings(),
                          lanes = evaluation.score().of(evaluation::LineKind::lane);
  const evaluation::PairScore& linkages = evaluation.topology().linkages;
  std::printf("%s: markings P/R/F1 %.1f/%.1f/%.1f %%, lanes %.1f/%.1f/%.1f %%, linkages P/R %.0f/%.0f %%\n",
              what, 100 * markings.precision(), 100 * markings.recall(), 100 * markings.f1(),
              100 * lanes.precision(), 100 * lanes.recall(), 100 * lanes.f1(), 100 * linkages.precision(),
              100 * linkages.recall());
}

/// A road that is driven once, as a network sees it.
struct DrivenOnce {
  explicit DrivenOnce(const std::string& scenario) : DrivenOnce(test::map_drive(scenario, "inhouse")) {}

  evaluation::MapEvaluation local, exported;
  double driven_m = 0.0;  ///< length of the lanes that were driven
  double found_m = 0.0;   ///< the part of it that lies on lanes of the map

 private:
  explicit DrivenOnce(const test::MappedDrive& drive)
      : local(*drive.road, drive.config.range, evaluation::Subject::maps),
        exported(*drive.road, drive.config.range, evaluation::Subject::maps) {
    LocalMap whole = weave(test::surveyed(drive), drive.config);
    for (std::size_t i = kFirst; i < drive.maps.size(); i += kStep) {
      local.add(drive.maps[i]);
      whole.stamp_ns = drive.maps[i].stamp_ns;
      whole.T_map_body = drive.maps[i].T_map_body;
      exported.add(whole);
    }
    print("local maps", local);
    print("map of the drive", exported);

    std::vector<MeasuredPolyline> lanes;
    for (const Lane& lane : whole.lanes) lanes.emplace_back(lane.centerline);
    for (const simulation::RoadLane& lane : drive.road->lanes) {
      if (lane.in_intersection || !is_driven(lane, drive.road->drive)) continue;
      driven_m += length(lane.centerline);
      found_m += length(lane.centerline) * covered_share(lane, lanes);
    }
    std::printf("driven lanes: %.0f of %.0f m found\n", found_m, driven_m);
  }
};

double f1_of_lanes(const evaluation::MapEvaluation& maps) {
  return maps.score().of(evaluation::LineKind::lane).f1();
}

/// Is the whole map as good as the local ones?
TEST(Town, TheMapOfADriveIsAsGoodAsTheLocalMaps) {
  const DrivenOnce town("town");
  ASSERT_GT(town.driven_m, 500.0);
  // 94 % were found, and the lanes' F1 was 1.4 points above that of the local maps.
  EXPECT_GE(town.found_m, 0.93 * town.driven_m);
  EXPECT_GE(town.exported.score().markings().f1(), town.local.score().markings().f1());
  EXPECT_GE(f1_of_lanes(town.exported), f1_of_lanes(town.local));
}

TEST(Street, TheLanesOfADriveGoOnWhereAnEdgeWasNotSeen) {
  const DrivenOnce street("street");
  ASSERT_GT(street.driven_m, 200.0);
  // 85 % were found, and the lanes' F1 was 10.6 points above that of the local maps.
  EXPECT_GE(street.found_m, 0.84 * street.driven_m);
  EXPECT_GE(f1_of_lanes(street.exported), f1_of_lanes(street.local));
}

}  // namespace
}  // namespace laneloom::exports
