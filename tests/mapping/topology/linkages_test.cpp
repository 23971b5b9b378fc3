#include "mapping/topology/linkages.hpp"

#include <gmock/gmock.h>

#include <numbers>
#include <set>

#include "mapping/lanes/lane_geometry.hpp"
#include "mapping/shapes.hpp"

namespace laneloom::topology {
namespace {

using Kind = Linkage::Kind;

Lane lane(ElementId id, std::pair<ElementId, Stretch> left, std::pair<ElementId, Stretch> right,
          Polyline centerline) {
  Lane l;
  l.id = id;
  l.left_borders = {{.boundary = left.first}};
  l.left_borders.front().on_boundary = left.second;
  l.right_borders = {{.boundary = right.first}};
  l.right_borders.front().on_boundary = right.second;
  l.centerline = std::move(centerline);
  return l;
}

std::vector<Linkage> linkages_of(const std::vector<Lane>& lanes, const std::set<ElementId>& edges = {}) {
  std::vector<boundaries::LaneBoundary> boundaries;
  for (const ElementId id : {10U, 11U, 20U, 21U, 22U, 30U, 40U})
    boundaries.push_back(test::boundary(id, test::straight({0, 0, 0}, {60, 0, 0}),
                                        edges.contains(id) ? MarkingType::roadedge : MarkingType::laneline));
  return link_lanes({std::move(boundaries), lanes}, {}).linkages;
}

std::vector<std::tuple<ElementId, ElementId, Kind>> links(const std::vector<Lane>& lanes) {
  std::vector<std::tuple<ElementId, ElementId, Kind>> result;
  for (const Linkage& l : linkages_of(lanes)) result.emplace_back(l.from, l.to, l.kind);
  return result;
}

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(Linkages, TheBordersOfBothLanesAreTheirEvidence) {
  Lane from = lane(1, {10, {0, 20}}, {40, {0, 20}}, test::straight({0, 0, 0}, {20, 0, 0}));
  Lane to = lane(2, {10, {24, 50}}, {20, {0, 26}}, test::straight({24, 0, 0}, {50, 0, 0}));
  from.evidence = Evidence::markings | Evidence::ego_path;
  to.evidence = Evidence::edges;
  const auto linkages = linkages_of({from, to});
  ASSERT_EQ(linkages.size(), 1U);
  EXPECT_EQ(linkages[0].evidence, Evidence::markings | Evidence::edges)
      << "nobody drove from one to the other";
}

// Paper, Fig. 5 (e): lane 1 goes on in 2 and 4 by the boundaries that it shares with them, in 3 by geometry.
TEST(Linkages, BySharedBoundaryAndByAlignment) {
  const std::vector<Lane> lanes{
      lane(1, {10, {0, 20}}, {40, {0, 20}}, test::straight({0, 0, 0}, {20, 0, 0})),
      lane(2, {10, {24, 50}}, {20, {0, 26}}, test::straight({24, 4, 0}, {50, 6, 0})),
      lane(3, {20, {0, 26}}, {30, {0, 26}}, test::straight({24, 0.5, 0}, {50, 0.5, 0})),
      lane(4, {30, {0, 26}}, {40, {24, 50}}, test::straight({24, -4, 0}, {50, -6, 0}))};
  EXPECT_THAT(links(lanes), ElementsAre(std::tuple(1, 2, Kind::shared_boundary),
                                        std::tuple(1, 3, Kind::geometric_alignment),
                                        std::tuple(1, 4, Kind::shared_boundary)));
}

// The left kerb of a narrow street leads round the corner, into the oncoming lane of the street that crosses.
TEST(Linkages, RoundACornerOfANarrowStreetOnlyBetweenTheSameKerbs) {
  const Lane narrow = lane(1, {10, {0, 20}}, {20, {0, 20}}, test::straight({0, 0, 0}, {20, 0, 0}));
  const Lane across = lane(2, {10, {30, 50}}, {30, {0, 20}}, test::straight({25, 5, 0}, {25, 25, 0}));
  const Lane bend = lane(2, {10, {30, 50}}, {20, {30, 50}}, test::straight({25, 5, 0}, {25, 25, 0}));
  EXPECT_EQ(linkages_of({narrow, across}, {10, 20}).size(), 0U);
  EXPECT_EQ(linkages_of({narrow, bend}, {10, 20}).size(), 1U);
  EXPECT_EQ(linkages_of({narrow, across}, {10}).size(), 1U) << "its right border is a line";
}

TEST(Linkages, AlongABoundaryThatRunsAgainstTheLanes) {
  std::vector<Lane> lanes{lane(1, {10, {40, 60}}, {20, {0, 20}}, test::straight({0, 0, 0}, {20, 0, 0})),
                          lane(2, {10, {10, 36}}, {21, {0, 26}}, test::straight({24, 2, 0}, {50, 2, 0}))};
  for (Lane& l : lanes) l.left_borders.front().reversed = true;
  EXPECT_THAT(links(lanes), ElementsAre(std::tuple(1, 2, Kind::shared_boundary)));
  const Polyline path = linkages_of(lanes)[0].path;
  EXPECT_TRUE(path.front().isApprox(lanes[0].centerline.back()));
  EXPECT_TRUE(path.back().isApprox(lanes[1].centerline.front()));
}

TEST(Linkages, LanesThatRunAgainstEachOtherAlongABoundaryAreNotLinked) {
  std::vector<Lane> lanes{lane(1, {10, {0, 20}}, {20, {0, 20}}, test::straight({0, 0, 0}, {20, 0, 0})),
                          lane(2, {21, {0, 26}}, {10, {24, 50}}, test::straight({50, 2, 0}, {24, 2, 0}))};
  lanes[1].right_borders.front().reversed = true;
  EXPECT_THAT(links(lanes), IsEmpty());
}

TEST(Linkages, GoToTheNextLaneOnly) {
  const std::vector<Lane> lanes{
      lane(1, {10, {0, 10}}, {20, {0, 10}}, test::straight({0, 0, 0}, {10, 0, 0})),
      lane(2, {10, {11, 20}}, {21, {0, 9}}, test::straight({11, 0, 0}, {20, 0, 0})),
      lane(3, {10, {22, 30}}, {22, {0, 9}}, test::straight({22, 0, 0}, {30, 0, 0}))};
  EXPECT_THAT(links(lanes),
              ElementsAre(std::tuple(1, 2, Kind::shared_boundary), std::tuple(2, 3, Kind::shared_boundary)));
}

TEST(Linkages, NeighboursAreNoSuccessors) {
  // The boundary between them is the right one of the first and the left one of the second.
  const std::vector<Lane> lanes{
      lane(1, {10, {0, 30}}, {20, {0, 30}}, test::straight({0, 3.5, 0}, {30, 3.5, 0})),
      lane(2, {20, {0, 30}}, {30, {0, 30}}, test::straight({0, 0, 0}, {30, 0, 0}))};
  EXPECT_THAT(links(lanes), IsEmpty());
}

TEST(Linkages, NotAcrossTooLongAGapNorAroundACorner) {
  const Lane from = lane(1, {10, {0, 20}}, {11, {0, 20}}, test::straight({0, 0, 0}, {20, 0, 0}));
  const Lane far = lane(2, {20, {0, 20}}, {21, {0, 20}}, test::straight({26, 0, 0}, {40, 0, 0}));
  const Lane beside = lane(2, {20, {0, 20}}, {21, {0, 20}}, test::straight({22, 1.5, 0}, {40, 1.5, 0}));
  const Lane turning = lane(2, {20, {0, 20}}, {21, {0, 20}}, test::straight({22, 0, 0}, {32, 5, 0}));
  const Lane good = lane(2, {20, {0, 20}}, {21, {0, 20}}, test::straight({22, 0.3, 0}, {40, 0.5, 0}));
  for (const Lane& to : {far, beside, turning}) EXPECT_THAT(links({from, to}), IsEmpty());
  EXPECT_THAT(links({from, good}), ElementsAre(std::tuple(1, 2, Kind::geometric_alignment)));
}

TEST(Linkages, ConfidenceFallsWithTheGap) {
  const Lane from = lane(1, {10, {0, 20}}, {11, {0, 20}}, test::straight({0, 0, 0}, {20, 0, 0}));
  double before = 1.1;
  for (const double gap_m : {0.0, 2.0, 4.0}) {
    const Lane to = lane(2, {20, {0, 20}}, {21, {0, 20}}, test::straight({20 + gap_m, 0, 0}, {40, 0, 0}));
    const auto linkages = linkages_of({from, to});
    ASSERT_EQ(linkages.size(), 1U);
    EXPECT_LT(linkages[0].probability, before);
    before = linkages[0].probability;
  }
  EXPECT_GE(before, 0.5);
}

TEST(Linkages, RoundACornerTheWayKeepsBesideTheSharedEdge) {
  // The edge: 20 m east, a quarter of a circle of 8 m to the right, 20 m south. 12.6 m of arc.
  Polyline edge = test::straight({0, -1.75, 0}, {20, -1.75, 0});
  for (const Point& point : test::arc({20, -9.75, 0}, 8, 90, 0)) edge.push_back(point);
  for (const Point& point : test::straight({28, -9.75, 0}, {28, -29.75, 0})) edge.push_back(point);
  const std::vector<boundaries::LaneBoundary> boundaries{test::boundary(20, edge)};
  const double arc_m = 4.0 * std::numbers::pi;
  const Lane from = lane(1, {10, {0, 20}}, {20, {0, 20}}, test::straight({0, 0, 0}, {20, 0, 0}));
  const Lane to = lane(2, {11, {0, 20}}, {20, {20 + arc_m, 40 + arc_m}},
                       test::straight({29.75, -9.75, 0}, {29.75, -29.75, 0}));
  const auto linkages = link_lanes({boundaries, {from, to}}, {}).linkages;
  ASSERT_EQ(linkages.size(), 1U);
  const Polyline& path = linkages[0].path;
  ASSERT_GT(path.size(), 10U);
  EXPECT_TRUE(path.front().isApprox(from.centerline.back()));
  EXPECT_TRUE(path.back().isApprox(to.centerline.front()));
  for (const Point& point : path) EXPECT_NEAR((point - Point(20, -9.75, 0)).norm(), 9.75, 0.25);
  EXPECT_EQ(turn_between(from, to), Linkage::Turn::right);
}

TEST(Linkages, LanesThatMeetNeedNoPath) {
  const Lane from = lane(1, {10, {0, 20}}, {11, {0, 20}}, test::straight({0, 0, 0}, {20, 0, 0}));
  for (const double gap_m : {-1.5, 0.0, 0.5, 3.0}) {
    const Lane shared =
        lane(2, {10, {20 + gap_m, 40}}, {21, {0, 20}}, test::straight({20 + gap_m, 0, 0}, {40, 0, 0}));
    const Lane aligned =
        lane(2, {20, {0, 20}}, {21, {0, 20}}, test::straight({20 + gap_m, 0, 0}, {40, 0, 0}));
    for (const Lane& to : {shared, aligned}) EXPECT_EQ(linkages_of({from, to})[0].path.empty(), gap_m < 1.0);
  }
}

}  // namespace
}  // namespace laneloom::topology
