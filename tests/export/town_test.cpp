#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

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

/// A town that is driven once, as a network sees it: is the whole map as good as the local ones?
TEST(Town, TheMapOfADriveIsAsGoodAsTheLocalMaps) {
  const test::MappedDrive drive = test::map_drive("town", "inhouse");
  LocalMap whole = weave(test::accumulated(drive), drive.config);
  evaluation::MapEvaluation local(*drive.road, drive.config.range, evaluation::Subject::maps),
      exported(*drive.road, drive.config.range, evaluation::Subject::maps);
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
  double driven_m = 0.0, found_m = 0.0;
  for (const simulation::RoadLane& lane : drive.road->lanes) {
    if (lane.in_intersection || !is_driven(lane, drive.road->drive)) continue;
    driven_m += length(lane.centerline);
    found_m += length(lane.centerline) * covered_share(lane, lanes);
  }
  std::printf("driven lanes: %.0f of %.0f m found\n", found_m, driven_m);
  ASSERT_GT(driven_m, 500.0);
  // 94 % were found, and the lanes' F1 was 1.4 points below that of the local maps.
  EXPECT_GE(found_m, 0.93 * driven_m);
  EXPECT_GE(exported.score().markings().f1(), local.score().markings().f1());
  EXPECT_GE(exported.score().of(evaluation::LineKind::lane).f1(),
            local.score().of(evaluation::LineKind::lane).f1() - 0.02);
}

}  // namespace
}  // namespace laneloom::exports
