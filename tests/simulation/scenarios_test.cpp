#include "simulation/scenarios.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>

#include "laneloom/polyline.hpp"
#include "road_checks.hpp"
#include "thrown_by.hpp"

namespace laneloom::simulation {
namespace {

std::size_t count(const Road& road, MarkingType type, MarkingStyle style) {
  return static_cast<std::size_t>(
      std::count_if(road.markings.begin(), road.markings.end(),
                    [&](const RoadMarking& m) { return m.type == type && m.style == style; }));
}

RoadLane lane_at(const Road& road, const Point& point) {
  const auto found = std::find_if(road.lanes.begin(), road.lanes.end(), [&](const RoadLane& lane) {
    const Projection foot = MeasuredPolyline(lane.centerline).project(point);
    return foot.inside && foot.distance_m < 1.0 && !lane.in_intersection;
  });
  if (found == road.lanes.end()) throw std::logic_error("no lane there");
  return *found;
}

class EveryScenario : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Named, EveryScenario, testing::ValuesIn(scenario_names()),
                         [](const auto& scenario) { return scenario.param; });

TEST_P(EveryScenario, LanesHaveTheirWidthAndSides) {
  const Road road = make_scenario(GetParam());
  EXPECT_EQ(road.name, GetParam());
  for (const RoadLane& lane : road.lanes) {
    expect_left_is_left(lane);
    expect_successors_meet(road, lane, 0.02);
    for (std::size_t i = 0; i < lane.left.size() && !lane.in_intersection; ++i) {
      EXPECT_GT((lane.left[i] - lane.right.at(i)).norm(), 2.5 - 1e-6) << "lane " << lane.id;
      EXPECT_LT((lane.left[i] - lane.right.at(i)).norm(), 3.5 + 1e-6) << "lane " << lane.id;
    }
    const bool unseen = lane.left_marking == kNoElement && lane.right_marking == kNoElement;
    EXPECT_EQ(lane.in_intersection, unseen) << "lane " << lane.id;
  }
  expect_borders_on_markings(road, 1e-6);
}

TEST_P(EveryScenario, MarkingsAreFinelySampledAndNotRepeated) {
  for (const RoadMarking& marking : make_scenario(GetParam()).markings) {
    for (std::size_t i = 1; i < marking.points.size(); ++i) {
      const double step_m = (marking.points[i] - marking.points[i - 1]).norm();
      EXPECT_GT(step_m, 1e-3) << "marking " << marking.id;
      if (marking.type != MarkingType::stopline) {
        EXPECT_LT(step_m, 2.0) << "marking " << marking.id;
      }
    }
  }
}

TEST_P(EveryScenario, IsDrivenInALaneWithoutJumps) {
  const Road road = make_scenario(GetParam(), 10.0);
  const double laps_s = road.drive.duration_s() * (road.drive.closed() ? 2.0 : 1.0);
  for (double t = 0.1; t < laps_s; t += 0.1) {
    const VehiclePose before = road.drive.pose_at(t - 0.1), now = road.drive.pose_at(t);
    EXPECT_NEAR((now.position - before.position).norm(), 1.0, 0.02) << "at " << t;
    EXPECT_LT(now.orientation.angularDistance(before.orientation), 0.15) << "at " << t;
    double off_m = 1e9;
    for (const RoadLane& lane : road.lanes)
      off_m = std::min(off_m,
                       (MeasuredPolyline(lane.centerline).project(now.position).foot - now.position).norm());
    EXPECT_LT(off_m, 0.3) << "at " << t;
  }
}

TEST(Straight, HasThreeLanesPerDirection) {
  const Road road = make_scenario("straight");
  EXPECT_EQ(road.lanes.size(), 6u);
  EXPECT_EQ(count(road, MarkingType::laneline, MarkingStyle::dashed), 4u);
  EXPECT_EQ(count(road, MarkingType::laneline, MarkingStyle::solid), 2u);
  EXPECT_EQ(count(road, MarkingType::roadedge, MarkingStyle::solid), 2u);
  for (const RoadLane& lane : road.lanes) {
    const double heading_x = (lane.centerline.back() - lane.centerline.front()).x();
    EXPECT_NEAR(std::abs(heading_x), 300.0, 1e-9);
    EXPECT_EQ(heading_x > 0.0, lane.centerline.front().y() < 0.0) << "traffic keeps to the right";
  }
}

TEST(Curve, BendsBy90DegreesOn12Metres) {
  const Road road = make_scenario("curve");
  const auto centre = std::find_if(road.markings.begin(), road.markings.end(),
                                   [](const RoadMarking& m) { return m.type == MarkingType::laneline; });
  const Point bend_centre(80.0, 12.0, 0.0);
  std::size_t on_bend = 0;
  for (const Point& p : centre->points) {
    if (p.x() <= 80.0 || p.y() >= 12.0) continue;
    EXPECT_NEAR((p - bend_centre).norm(), 12.0, 1e-9);
    ++on_bend;
  }
  EXPECT_GE(on_bend, 10u);
  EXPECT_NEAR(centre->points.back().x(), 92.0, 1e-9);
}

TEST(CountryRoad, HasNothingButALineBetweenItsDirectionsFurtherOn) {
  const Road road = make_scenario("country_road");
  EXPECT_EQ(count(road, MarkingType::laneline, MarkingStyle::dashed), 1U);
  EXPECT_EQ(count(road, MarkingType::roadedge, MarkingStyle::solid), 2U);
  for (const RoadMarking& marking : road.markings)
    EXPECT_NEAR(length(marking.points), marking.type == MarkingType::roadedge ? 60.0 : 287.1, 0.1);
  const RoadLane ahead = lane_at(road, {100.0, -1.75, 0.0});
  EXPECT_NE(ahead.left_marking, kNoElement);
  EXPECT_EQ(ahead.right_marking, kNoElement);
}

TEST(Motorway, HasAShoulderThatIsNoLaneOnEitherSide) {
  const Road road = make_scenario("motorway");
  EXPECT_EQ(road.lanes.size(), 4U);
  EXPECT_EQ(count(road, MarkingType::roadedge, MarkingStyle::solid), 2U);
  EXPECT_EQ(count(road, MarkingType::laneline, MarkingStyle::solid), 4U);
  for (const double y : {-5.37, 5.37}) {
    const Point border = lane_at(road, {50.0, y, 0.0}).right[10];
    double nearest_m = 100.0;
    for (const RoadMarking& marking : road.markings)
      if (marking.type == MarkingType::roadedge)
        nearest_m = std::min(nearest_m, MeasuredPolyline(marking.points).project(border).distance_m);
    EXPECT_NEAR(nearest_m, 2.4, 1e-6);
  }
}

TEST(Street, HasNoLineBetweenItsDirectionsFurtherOn) {
  const Road road = make_scenario("street");
  EXPECT_EQ(lane_at(road, {30.0, -1.75, 0.0}).left_marking, lane_at(road, {30.0, 1.75, 0.0}).left_marking);
  EXPECT_NE(lane_at(road, {30.0, -1.75, 0.0}).left_marking, kNoElement);
  EXPECT_EQ(lane_at(road, {90.0, -1.75, 0.0}).left_marking, kNoElement);
  EXPECT_NE(lane_at(road, {90.0, -1.75, 0.0}).right_marking, kNoElement);
  EXPECT_EQ(count(road, MarkingType::laneline, MarkingStyle::dashed), 1u);
}

TEST(Split, TheLaneOpensAtTwoAndAHalfMetresAndItsDashesBeginWithTheTaper) {
  const Road road = make_scenario("split");
  const auto dashed = std::find_if(road.markings.begin(), road.markings.end(),
                                   [](const RoadMarking& m) { return m.style == MarkingStyle::dashed; });
  EXPECT_NEAR(dashed->points.front().x(), 80.0, 1e-6);
  EXPECT_NEAR(dashed->points.back().x(), 200.0, 1e-6);
  const RoadLane added = lane_at(road, {150.0, -5.25, 0.0});
  EXPECT_NEAR((added.left.front() - added.right.front()).norm(), 2.5, 0.12);  // to the metre along the road
  const RoadLane before = lane_at(road, {90.0, -1.75, 0.0});
  const RoadLane through = lane_at(road, {150.0, -1.75, 0.0});
  EXPECT_EQ(std::set<ElementId>(before.successors.begin(), before.successors.end()),
            (std::set<ElementId>{through.id, added.id}));
  ASSERT_EQ(added.successors.size(), 1u);
  const RoadLane& exit = lane_of(road, added.successors.front());
  EXPECT_LT(exit.centerline.back().y(), exit.centerline.front().y() - 0.5) << "the exit turns away";
  EXPECT_EQ(through.successors.size(), 1u);
}

TEST(Merge, TwoLanesLeadIntoOne) {
  const Road road = make_scenario("merge");
  const RoadLane through = lane_at(road, {150.0, -1.75, 0.0});
  const RoadLane ending = lane_at(road, {150.0, -5.25, 0.0});
  EXPECT_EQ(through.successors, ending.successors);
  EXPECT_EQ(through.successors.size(), 1u);
  const auto ramp = std::find_if(road.lanes.begin(), road.lanes.end(), [&](const RoadLane& lane) {
    return lane.successors == std::vector<ElementId>{ending.id};
  });
  ASSERT_NE(ramp, road.lanes.end());
  EXPECT_LT(ramp->centerline.front().y(), ramp->centerline.back().y() - 0.5);
}

TEST(Intersection, EveryLaneThatArrivesGoesThreeWays) {
  const Road road = make_scenario("intersection");
  EXPECT_EQ(count(road, MarkingType::stopline, MarkingStyle::solid), 4u);
  std::size_t arriving = 0;
  for (const RoadLane& lane : road.lanes) {
    if (lane.in_intersection || lane.successors.empty()) continue;
    ++arriving;
    EXPECT_EQ(lane.successors.size(), 3u);
    for (const ElementId id : lane.successors) {
      EXPECT_TRUE(lane_of(road, id).in_intersection);
      EXPECT_EQ(lane_of(road, id).successors.size(), 1u);
    }
  }
  EXPECT_EQ(arriving, 4u);
  // South-east corner: a quarter circle of 8 m about (11.5, -11.5).
  std::size_t on_corner = 0;
  for (const RoadMarking& marking : road.markings) {
    if (marking.type != MarkingType::roadedge) continue;
    for (const Point& p : marking.points) {
      if (p.x() < 3.6 || p.x() > 11.4 || p.y() > -3.6 || p.y() < -11.4) continue;
      EXPECT_NEAR((p - Point(11.5, -11.5, 0.0)).norm(), 8.0, 1e-6);
      ++on_corner;
    }
  }
  EXPECT_GE(on_corner, 8u);
}

TEST(TIntersection, TheStemGoesLeftAndRight) {
  const Road road = make_scenario("t_intersection");
  EXPECT_EQ(count(road, MarkingType::stopline, MarkingStyle::solid), 3u);
  EXPECT_EQ(lane_at(road, {1.75, -50.0, 0.0}).successors.size(), 2u);
  EXPECT_EQ(count(road, MarkingType::roadedge, MarkingStyle::solid), 3u)
      << "opposite of the stem it is one edge";
}

TEST(Hill, ClimbsAtMostEightPercent) {
  const Road road = make_scenario("hill");
  double steepest = 0.0, highest_m = 0.0;
  for (const VehiclePose& pose : road.drive.poses()) {
    const Point forward = pose.orientation * Point::UnitX();
    steepest = std::max(steepest, forward.z() / forward.head<2>().norm());
    highest_m = std::max(highest_m, pose.position.z());
  }
  EXPECT_NEAR(steepest, 0.08, 0.002);
  EXPECT_NEAR(highest_m, 8.0, 0.01);
}

TEST(Overpass, IsDrivenOverAndUnderTheSamePlace) {
  const Road road = make_scenario("overpass");
  double highest_m = -1e9, lowest_m = 1e9;
  for (const VehiclePose& pose : road.drive.poses()) {
    if (pose.position.head<2>().norm() > 5.0) continue;
    highest_m = std::max(highest_m, pose.position.z());
    lowest_m = std::min(lowest_m, pose.position.z());
  }
  EXPECT_NEAR(highest_m - lowest_m, 6.0, 0.01);
}

TEST(Town, IsALongClosedLoop) {
  const Road road = make_scenario("town", 10.0);
  EXPECT_TRUE(road.drive.closed());
  EXPECT_GT(road.drive.duration_s(), 150.0);
  const VehiclePose first = road.drive.pose_at(0.0), lap = road.drive.pose_at(road.drive.duration_s());
  EXPECT_LT((first.position - lap.position).norm(), 1e-6);
  EXPECT_EQ(count(road, MarkingType::stopline, MarkingStyle::solid), 15u);
}

TEST(Scenario, AnUnknownNameNamesTheKnownOnes) {
  EXPECT_THAT(thrown_by<std::invalid_argument>([&] { make_scenario("moon"); }),
              testing::HasSubstr("overpass"));
}

}  // namespace
}  // namespace laneloom::simulation
