#include "mapping/lanes/continued_edges.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "mapping/boundaries/road_sections.hpp"
#include "mapping/lanes/find_lanes.hpp"
#include "mapping/lanes/inferred_memory.hpp"
#include "mapping/lanes/lane_tracks.hpp"
#include "mapping/shapes.hpp"

namespace laneloom::lanes {
namespace {

using test::boundary;
using test::straight;
using ::testing::IsEmpty;
using ::testing::SizeIs;

boundaries::LaneBoundary edge(ElementId id, const Polyline& points) {
  return boundary(id, points, MarkingType::roadedge);
}

boundaries::LaneBoundary edge(ElementId id, double y, double from_x, double to_x) {
  return edge(id, straight({from_x, y, 0}, {to_x, y, 0}, 31));
}

/// About a vehicle at the origin, with everything in the box.
geometry::Scene wide_scene(std::uint64_t frame) {
  const RangeConfig range{.forward_min_m = -60.0, .forward_max_m = 100.0, .side_max_m = 60.0};
  return {.box = geometry::MapBox(range, test::at(0)),
          .stamp_ns = static_cast<std::int64_t>(frame),
          .frame = frame};
}

std::vector<Marking> continued(std::vector<boundaries::LaneBoundary> boundaries,
                               const LaneConfig& config = {}) {
  return continued_edges(std::move(boundaries), wide_scene(1).box, config);
}

TEST(ContinuedEdges, GoOnBesideTheEdgeAcrossTheRoad) {
  const auto found = continued({edge(1, 3.5, -20, 60), edge(2, -3.5, -20, 20)});
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].type, MarkingType::roadedge);
  EXPECT_EQ(found[0].status, ElementStatus::inferred);
  EXPECT_TRUE(found[0].points.front().isApprox(Point(20, -3.5, 0)));
  EXPECT_NEAR(length(found[0].points), 30.0, 1e-6);
  for (const Point& point : found[0].points) EXPECT_NEAR(point.y(), -3.5, 1e-9);
}

TEST(ContinuedEdges, WhicheverWayTheEdgesRun) {
  auto left = edge(1, 3.5, -20, 60), right = edge(2, -3.5, 0, 60);
  std::ranges::reverse(left.marking.points);
  const auto found = continued({left, right});
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_TRUE(found[0].points.front().isApprox(Point(0, -3.5, 0)));
  EXPECT_NEAR(found[0].points.back().x(), -20.0, 1.0);
}

TEST(ContinuedEdges, RoundABend) {
  const Point center{0, 40, 0};
  const auto found =
      continued({edge(1, test::arc(center, 36.5, -90, -10)), edge(2, test::arc(center, 43.5, -90, -60))});
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_NEAR(length(found[0].points), 30.0 * 43.5 / 36.5, 1.5);
  for (const Point& point : found[0].points) EXPECT_NEAR((point - center).norm(), 43.5, 0.1);
}

TEST(ContinuedEdges, LeadFromOneEndToTheOtherOnce) {
  const auto found = continued({edge(1, 3.5, -20, 60), edge(2, -3.5, -20, 20), edge(3, -3.6, 40, 60)});
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_NEAR(found[0].points.front().x(), 20.0, 1e-9);
  EXPECT_NEAR(found[0].points.back().x(), 39.0, 1.0);
}

TEST(ContinuedEdges, AreAtLeastAsLongAsInferredLanes) {
  EXPECT_THAT(continued({edge(1, 3.5, -20, 27), edge(2, -3.5, -20, 20)}), IsEmpty());
  EXPECT_THAT(continued({edge(1, 3.5, -20, 29), edge(2, -3.5, -20, 20)}), SizeIs(1));
}

TEST(ContinuedEdges, KeepTheirHeightAboveTheOtherEdge) {
  auto low = edge(2, -3.5, -20, 20);
  for (Point& point : low.marking.points) point.z() = -0.2;
  const auto found = continued({edge(1, 3.5, -20, 60), low});
  ASSERT_THAT(found, SizeIs(1));
  for (const Point& point : found[0].points) EXPECT_NEAR(point.z(), -0.2, 1e-9);
}

TEST(ContinuedEdges, EndWhereTheOtherEdgeTurnsOffRoundACorner) {
  Polyline corner = straight({-20, 3.5, 0}, {30, 3.5, 0}, 51);
  for (const Point& point : test::arc({30, 8.5, 0}, 5, -90, 0)) corner.push_back(point);
  corner.emplace_back(35, 40, 0);
  const auto found = continued({edge(1, corner), edge(2, -3.5, -20, 20)});
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_NEAR(found[0].points.back().x(), 29.0, 2.0);
}

TEST(ContinuedEdges, EndWithTheBox) {
  const boundaries::Boundaries road = std::vector{edge(1, 3.5, -20, 60), edge(2, -3.5, -20, 20)};
  const auto found = continued_edges(road, test::scene(1).box, {});
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_NEAR(found[0].points.back().x(), RangeConfig{}.forward_max_m, 1.0);
}

TEST(ContinuedEdges, OnlyOnRoadsWithoutLines) {
  EXPECT_THAT(continued({edge(1, 3.5, -20, 60), edge(2, -3.5, -20, 20),
                         boundary(3, straight({-20, 0, 0}, {60, 0, 0}))}),
              IsEmpty());
}

TEST(ContinuedEdges, NotWhereTheRoadWidensBeforeItsEdgeEnds) {
  EXPECT_THAT(continued({edge(1, 3.5, -20, 60), edge(2, straight({-20, -3.5, 0}, {20, -7.5, 0}, 41))}),
              IsEmpty());
}

TEST(ContinuedEdges, NotWhereBothEdgesEnd) {
  EXPECT_THAT(continued({edge(1, 3.5, -20, 20), edge(2, -3.5, -20, 20)}), IsEmpty());
}

TEST(ContinuedEdges, NotBesideWhatIsTooNarrowForTwoLanes) {
  EXPECT_THAT(continued({edge(1, 3.5, -20, 60), edge(2, -1.5, -20, 20)}), IsEmpty());
}

TEST(ContinuedEdges, NotIfUnmarkedRoadsAreNotDivided) {
  EXPECT_THAT(continued({edge(1, 3.5, -20, 60), edge(2, -3.5, -20, 20)}, {.unmarked_roads = false}),
              IsEmpty());
}

TEST(ContinuedEdges, NotFromAnEdgeThatIsNotSure) {
  auto unsure = edge(2, -3.5, -20, 20);
  unsure.marking.status = ElementStatus::tentative;
  EXPECT_THAT(continued({edge(1, 3.5, -20, 60), unsure}), IsEmpty());
}

/// The lanes of a road without lines whose right edge is not seen from 20 m on, frame by frame.
class RoadWithAnUnseenEdge : public ::testing::Test {
 protected:
  LaneLayout map(double end_x) {
    const geometry::Scene scene = wide_scene(++frame_);
    boundaries::Boundaries boundaries = std::vector{edge(1, 3.5, -20, end_x), edge(2, -3.5, -20, 20)};
    boundaries.insert(memory_.recognise(continued_edges(boundaries, scene.box, {}), scene, ids_));
    FoundLanes found =
        find_lanes(road_sections(std::move(boundaries), test::at(0), {}), scene.box, {}, {}, {});
    return tracks_.adopt(memory_.recognise(std::move(found), scene, {}, ids_), ids_);
  }

  std::uint64_t frame_ = 0;
  markings::IdSource ids_{100};
  InferredMemory memory_;
  LaneTracks tracks_;
};

TEST_F(RoadWithAnUnseenEdge, HasItsTwoLanesThere) {
  const LaneLayout layout = map(60);
  ASSERT_THAT(layout.lanes, SizeIs(4));
  for (const Lane& lane : layout.lanes) {
    EXPECT_NEAR(lane.width_m, 3.5, 0.1);
    EXPECT_EQ(lane.status, ElementStatus::inferred);
    ASSERT_THAT(lane.inferred_ranges, SizeIs(1));
    EXPECT_NEAR(lane.inferred_ranges[0].length(), length(lane.centerline), 1e-9);
  }
  EXPECT_EQ(std::ranges::count_if(layout.lanes, [](const Lane& l) { return l.centerline.back().x() > 45.0; }),
            2);
}

TEST_F(RoadWithAnUnseenEdge, KeepsItsIdsAndGivesNoneTwice) {
  const auto ids_of = [](const LaneLayout& layout) {
    std::vector<ElementId> ids;
    for (const boundaries::LaneBoundary& boundary : layout.boundaries) ids.push_back(boundary.marking.id);
    return ids;
  };
  const std::vector<ElementId> first = ids_of(map(60));
  EXPECT_THAT(std::set<ElementId>(first.begin(), first.end()), SizeIs(first.size()));
  EXPECT_EQ(ids_of(map(57)), first);
}

}  // namespace
}  // namespace laneloom::lanes
