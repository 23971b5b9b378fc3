#include <gtest/gtest.h>

#include <algorithm>

#include "contract/contract.hpp"
#include "laneloom/mapper.hpp"
#include "laneloom/polyline.hpp"
#include "published.hpp"
#include "simulation/perception.hpp"
#include "simulation/road_builder.hpp"

/// Perfect detections of a street whose centre line is solid at first, then dashed.
namespace laneloom {
namespace {

constexpr double kChange_m = 100.0;
constexpr double kAround_m = 5.0;

simulation::Road street() {
  const simulation::Alignment before({}, {simulation::straight(kChange_m)});
  const simulation::Alignment after(before.end(), {simulation::straight(100.0)});
  simulation::RoadBuilder builder("street");
  builder.add_street(before, two_way(2, 2, simulation::CentreLine::solid));
  builder.add_street(after, two_way(2, 2, simulation::CentreLine::dashed));
  return std::move(builder).build({before.point(10.0, -1.75), after.point(90.0, -1.75)}, 10.0);
}

bool spans_change(const Lane& lane) {
  const auto [from, to] = std::ranges::minmax(lane.centerline, {}, [](const Point& p) { return p.x(); });
  return from.x() < kChange_m - kAround_m && to.x() > kChange_m + kAround_m;
}

TEST(StyleChanges, CutNoLaneAndNeighboursAreWhatMayBeCrossedInto) {
  const simulation::Road road = street();
  Mapper mapper{MapperConfig{}};
  simulation::Perception perception(road, simulation::noise_profile("none"), simulation::SensorView{}, 1);
  int frames = 0;
  for (int i = 1; i < static_cast<int>(road.drive.duration_s() * 10.0); ++i) {
    const VehiclePose pose = road.drive.pose_at(0.1 * i);
    const PublishedMap published = test::published(mapper.update(perception.observe(pose), transform(pose)),
                                                   static_cast<std::uint64_t>(i));
    EXPECT_TRUE(contract::check_contract(published, nullptr).empty()) << "frame " << i;
    if (pose.position.x() < 85.0 || pose.position.x() > 110.0) continue;
    ++frames;
    const std::vector<Lane>& lanes = published.map.lanes;
    EXPECT_EQ(std::ranges::count_if(lanes, spans_change), 4) << "frame " << i;
    const auto inner = std::ranges::find_if(lanes, [](const Lane& lane) {
      return std::abs(lane.centerline.front().y() + 1.75) < 0.3 && spans_change(lane);
    });
    ASSERT_NE(inner, lanes.end());
    ASSERT_EQ(inner->left_neighbours.size(), 1U);
    const auto& crossable = inner->left_neighbours.front().crossable;
    ASSERT_EQ(crossable.size(), 1U);
    EXPECT_NEAR(MeasuredPolyline(inner->centerline).at(crossable.front().from_m).x(), kChange_m, 3.0);
  }
  EXPECT_GT(frames, 20);
}

}  // namespace
}  // namespace laneloom
