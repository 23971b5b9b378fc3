#include <gmock/gmock.h>

#include "laneloom/polyline.hpp"
#include "mapping/shapes.hpp"
#include "mapping/topology/meeting.hpp"

namespace laneloom::topology {
namespace {

using test::straight;

Lane bordered_lane(ElementId id, const Point& from, const Point& to, double width_m = 3.5) {
  Lane lane = test::lane(id, from, to);
  const Eigen::Vector2d ahead = (to - from).head<2>().normalized();
  const Point half = 0.5 * width_m * Point(-ahead.y(), ahead.x(), 0.0);
  lane.left = straight(from + half, to + half);
  lane.right = straight(from - half, to - half);
  return lane;
}

RoadGraph met(std::vector<Lane> lanes, std::vector<Linkage> linkages) {
  RoadGraph road{{{}, std::move(lanes)}, std::move(linkages)};
  meet_at_joints(road);
  return road;
}

/// The largest change of direction from one segment of a line to the next, as the sine of the angle.
double largest_kink(const Polyline& line) {
  double largest = 0.0;
  for (std::size_t i = 2; i < line.size(); ++i) {
    const Eigen::Vector2d a = (line[i - 1] - line[i - 2]).head<2>(), b = (line[i] - line[i - 1]).head<2>();
    largest = std::max(largest, std::abs(cross(a.normalized(), b.normalized())));
  }
  return largest;
}

TEST(MeetAtJoints, LanesWithAGapAndAStepMeetBetweenTheirEndsWithoutAKink) {
  const RoadGraph road =
      met({bordered_lane(1, {0, 0, 0}, {20, 0, 0}), bordered_lane(2, {21, 0.3, 0}, {40, 0.3, 0})},
          {{.from = 1, .to = 2}});
  const Polyline &from = road.lanes[0].centerline, &to = road.lanes[1].centerline;
  EXPECT_TRUE(from.back().isApprox(Point(20.5, 0.15, 0)));
  EXPECT_EQ(from.back(), to.front());
  EXPECT_EQ(from.front(), Point(0, 0, 0));
  EXPECT_EQ(to.back(), Point(40, 0.3, 0));
  Polyline way = from;
  way.insert(way.end(), to.begin() + 1, to.end());
  EXPECT_LT(largest_kink(way), 0.02);
}

TEST(MeetAtJoints, LanesThatOverlapMeet) {
  const RoadGraph road =
      met({bordered_lane(1, {0, 0, 0}, {20, 0, 0}), bordered_lane(2, {18.5, 0, 0}, {40, 0, 0})},
          {{.from = 1, .to = 2}});
  EXPECT_EQ(road.lanes[0].centerline.back(), road.lanes[1].centerline.front());
  const Polyline& line = road.lanes[0].centerline;
  for (std::size_t i = 1; i < line.size(); ++i) EXPECT_GT(line[i].x(), line[i - 1].x());
}

TEST(MeetAtJoints, StretchesOfALaneFollowItsCenterline) {
  Lane from = bordered_lane(1, {0, 0, 0}, {20, 0, 0});
  from.inferred_ranges = {{0.0, 20.0}};
  from.left_borders = {{7, {0.0, 2.0}, {0.0, 2.0}}, {8, {2.0, 20.0}, {0.0, 18.0}}};
  from.left_neighbours = {{.lane = 3, .range = {0.0, 20.0}, .crossable = {{0.0, 2.0}}}};
  const RoadGraph road = met({from, bordered_lane(2, {18.5, 0, 0}, {40, 0, 0})}, {{.from = 1, .to = 2}});
  const Lane& shorter = road.lanes[0];
  EXPECT_NEAR(length(shorter.centerline), 19.25, 1e-9);
  EXPECT_NEAR(shorter.inferred_ranges[0].to_m, 19.25, 1e-9);
  EXPECT_NEAR(shorter.left_neighbours[0].range.to_m, 19.25, 1e-9);
  EXPECT_EQ(shorter.left_borders[0].range.to_m, shorter.left_borders[1].range.from_m);
  EXPECT_NEAR(shorter.left_borders[1].range.to_m, 19.25, 1e-9);
  EXPECT_LE(shorter.left_neighbours[0].crossable[0].to_m, 2.0);
  EXPECT_GT(shorter.left_neighbours[0].crossable[0].to_m, 1.8);
}

TEST(MeetAtJoints, ACenterlineStaysInItsLane) {
  for (const double narrow_m : {3.5, 2.0}) {
    const RoadGraph road =
        met({bordered_lane(1, {0, 0, 0}, {20, 0, 0}), bordered_lane(2, {21, 2.1, 0}, {40, 2.1, 0}, narrow_m)},
            {{.from = 1, .to = 2}});
    EXPECT_EQ(road.lanes[0].centerline.back() == road.lanes[1].centerline.front(), narrow_m > 3.0);
    EXPECT_EQ(road.linkages[0].path.empty(), narrow_m > 3.0);
    for (const Lane& lane : road.lanes)
      for (const Point& point : lane.centerline)
        EXPECT_TRUE(point.y() < lane.left[0].y() && point.y() > lane.right[0].y());
  }
}

TEST(MeetAtJoints, ACenterlineStaysInALaneThatNarrows) {
  Lane narrows = bordered_lane(2, {0, 0, 0}, {40, 0, 0});
  narrows.centerline = straight({0, 0, 0}, {40, 0, 0}, 41);
  narrows.left = narrows.right = {};
  for (const Point& center : narrows.centerline) {
    const double half_m = center.x() < 10.0 ? 1.75 : 0.8;
    narrows.left.push_back(center + half_m * Point::UnitY());
    narrows.right.push_back(center - half_m * Point::UnitY());
  }
  const RoadGraph road =
      met({bordered_lane(1, {-20, 2.2, 0}, {-0.5, 2.2, 0}), narrows}, {{.from = 1, .to = 2}});
  const Lane& lane = road.lanes[1];
  EXPECT_EQ(lane.centerline.front(), road.lanes[0].centerline.back());
  for (std::size_t i = 0; i < lane.centerline.size(); ++i)
    EXPECT_LT(lane.centerline[i].y(), lane.left[i].y()) << i;
}

TEST(MeetAtJoints, APathBetweenLanesThatMeetIsLeftOut) {
  const RoadGraph road =
      met({bordered_lane(1, {0, 0, 0}, {20, 0, 0}), bordered_lane(2, {20.5, 0.2, 0}, {40, 2, 0}),
           bordered_lane(3, {20.4, -0.1, 0}, {40, -2, 0}), bordered_lane(4, {0, 1, 0}, {20, 0.1, 0})},
          {{.from = 1, .to = 3},
           {.from = 4, .to = 3},
           {.from = 4, .to = 2},
           {.from = 1, .to = 2, .path = {{20, 0, 0}, {20.5, 0.2, 0}}}});
  ASSERT_EQ(road.linkages.size(), 4U);
  EXPECT_TRUE(road.lanes[0].centerline.back().isApprox(road.lanes[1].centerline.front()));
  EXPECT_TRUE(road.linkages[3].path.empty());
}

TEST(MeetAtJoints, ThreeLanesMeetInOnePoint) {
  const RoadGraph road =
      met({bordered_lane(1, {0, 0, 0}, {20, 0, 0}), bordered_lane(2, {20.5, 0.3, 0}, {40, 2, 0}),
           bordered_lane(3, {20.5, -0.3, 0}, {40, -2, 0})},
          {{.from = 1, .to = 2}, {.from = 1, .to = 3}});
  EXPECT_EQ(road.lanes[0].centerline.back(), road.lanes[1].centerline.front());
  EXPECT_EQ(road.lanes[0].centerline.back(), road.lanes[2].centerline.front());
}

TEST(MeetAtJoints, ALinkageBetweenLanesThatLieFarApartGetsAPath) {
  const RoadGraph road =
      met({bordered_lane(1, {0, 0, 0}, {20, 0, 0}), bordered_lane(2, {30, 2, 0}, {50, 2, 0})},
          {{.from = 1, .to = 2}});
  ASSERT_EQ(road.linkages.size(), 1U);
  EXPECT_TRUE(road.linkages[0].path.front().isApprox(Point(20, 0, 0)));
  EXPECT_TRUE(road.linkages[0].path.back().isApprox(Point(30, 2, 0)));
}

TEST(MeetAtJoints, APathFollowsTheEndsThatItJoins) {
  const RoadGraph road =
      met({bordered_lane(1, {0, 0, 0}, {20, 0, 0}), bordered_lane(2, {20, 0.4, 0}, {40, 0, 0}),
           bordered_lane(3, {30, -10, 0}, {30, -30, 0})},
          {{.from = 1, .to = 2}, {.from = 1, .to = 3, .path = {{20, 0, 0}, {27, -3, 0}, {30, -10, 0}}}});
  EXPECT_TRUE(road.linkages[1].path.front().isApprox(road.lanes[0].centerline.back()));
  EXPECT_TRUE(road.linkages[1].path.back().isApprox(Point(30, -10, 0)));
}

TEST(MeetAtJoints, NoLinkageLeadsAside) {
  const RoadGraph road =
      met({bordered_lane(1, {0, 0, 0}, {20, 0, 0}), bordered_lane(2, {20.5, 5, 0}, {40, 5, 0})},
          {{.from = 1, .to = 2}});
  EXPECT_TRUE(road.linkages.empty());
}

TEST(MeetAtJoints, AStepAsideCostsProbabilityWhereTheNextLaneRunsOn) {
  const auto probability = [](const Lane& next) {
    const RoadGraph road = met({bordered_lane(1, {0, 0, 0}, {20, 0, 0}), next},
                               {{.from = 1, .to = 2, .probability = 0.9, .path = {{20, 0, 0}, {22, 0, 0}}}});
    return road.linkages.empty() ? 0.0 : road.linkages[0].probability;
  };
  EXPECT_DOUBLE_EQ(probability(bordered_lane(2, {26, 2, 0}, {40, 2, 0})), 0.9);  // 18 degrees
  EXPECT_LT(probability(bordered_lane(2, {22, 2, 0}, {40, 2, 0})), 0.5);         // 45 degrees
  EXPECT_DOUBLE_EQ(probability(bordered_lane(2, {26, 6, 0}, {26, 30, 0})), 0.9) << "a turn";
}

}  // namespace
}  // namespace laneloom::topology
