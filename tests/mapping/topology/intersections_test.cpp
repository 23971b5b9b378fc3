#include "mapping/topology/intersections.hpp"

#include <gmock/gmock.h>

#include "laneloom/polyline.hpp"
#include "mapping/lanes/lane_geometry.hpp"
#include "mapping/shapes.hpp"

namespace laneloom::topology {
namespace {

using test::lane;
using test::straight;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;
using Direction = Lane::Direction;
using Pair = std::pair<ElementId, ElementId>;

std::vector<Linkage> crossings(std::vector<Lane> lanes, std::vector<Linkage> known = {},
                               const LinkageConfig& config = {},
                               const std::vector<boundaries::LaneBoundary>& boundaries = {},
                               const SdMap& sd_map = {}) {
  RoadGraph road{{boundaries, std::move(lanes)}, std::move(known)};
  for (Linkage& linkage : road.linkages)
    linkage.turn = turn_between(road.lane(linkage.from), road.lane(linkage.to));
  link_across_intersections(sd_map, config, road);
  return road.linkages;
}

/// Whose driving direction is known.
Lane driven(ElementId id, const Point& from, const Point& to) {
  Lane l = lane(id, from, to);
  l.direction = Lane::Direction::along_centerline;
  return l;
}

/// A crossroads about (0, 0), with one lane in and one lane out on each arm, 10 m from its centre; right-hand
/// traffic. Ways in are 1 (from the west), 2 (south), 3 (east), 4 (north), ways out 11 to 14 likewise.
std::vector<Lane> crossroads() {
  std::vector<Lane> lanes;
  for (const auto& [id, angle] :
       {std::pair(1, std::numbers::pi), {2, 1.5 * std::numbers::pi}, {3, 0.0}, {4, 0.5 * std::numbers::pi}}) {
    const Eigen::AngleAxisd arm(angle, Point::UnitZ());
    const auto in = static_cast<ElementId>(id), out = in + 10;
    lanes.push_back(driven(in, arm * Point(25, 1.75, 0), arm * Point(10, 1.75, 0)));
    lanes.push_back(driven(out, arm * Point(10, -1.75, 0), arm * Point(25, -1.75, 0)));
    lanes[lanes.size() - 2].left_neighbours = {{.lane = out, .range = {0.0, 20.0}}};
    lanes.back().left_neighbours = {{.lane = in, .range = {0.0, 20.0}}};
  }
  std::ranges::sort(lanes, {}, &Lane::id);
  return lanes;
}

std::vector<Pair> pairs_of(const std::vector<Linkage>& linkages, Linkage::Turn turn) {
  std::vector<Pair> result;
  for (const Linkage& l : linkages)
    if (l.turn == turn) result.emplace_back(l.from, l.to);
  return result;
}

std::vector<Pair> pairs(const std::vector<Linkage>& linkages) {
  std::vector<Pair> result;
  for (const Linkage& l : linkages) result.emplace_back(l.from, l.to);
  return result;
}

TEST(Crossings, EachLaneGoesOnInTheOneAheadOfIt) {
  const auto linkages =
      crossings({lane(1, straight({0, 0, 0}, {10, 0, 0})), lane(2, straight({0, 3.5, 0}, {10, 3.5, 0})),
                 lane(3, straight({30, 0.4, 0}, {40, 0.4, 0})), lane(4, straight({30, 3.9, 0}, {40, 3.9, 0})),
                 lane(5, straight({20, -20, 0}, {20, -10, 0}))});
  EXPECT_THAT(pairs(linkages), ElementsAre(Pair(1, 3), Pair(2, 4)));
  for (const Linkage& linkage : linkages) {
    EXPECT_EQ(linkage.kind, Linkage::Kind::intersection);
    EXPECT_EQ(linkage.turn, Linkage::Turn::straight);
    EXPECT_GT(linkage.probability, 0.5);
    EXPECT_LT(linkage.probability, 0.9);
  }
}

TEST(Crossings, ThePathLeadsFromEndToBeginWithoutAKink) {
  const auto linkages =
      crossings({lane(1, straight({0, 0, 0}, {10, 0, 1})), lane(2, straight({30, 1, 2}, {40, 1.5, 2}))});
  ASSERT_EQ(linkages.size(), 1U);
  const Polyline& path = linkages[0].path;
  EXPECT_TRUE(path.front().isApprox(Point(10, 0, 1)));
  EXPECT_TRUE(path.back().isApprox(Point(30, 1, 2)));
  EXPECT_GT(end_direction(path, End::front, 1.0).dot(Eigen::Vector2d(-1, 0)), 0.995);
  for (std::size_t i = 2; i < path.size(); ++i) {
    const Eigen::Vector2d before = (path[i - 1] - path[i - 2]).head<2>().normalized();
    const Eigen::Vector2d after = (path[i] - path[i - 1]).head<2>().normalized();
    EXPECT_GT(before.dot(after), 0.99);
  }
}

TEST(Crossings, NotTooFarAsideOrAround) {
  const Lane from = lane(1, straight({0, 0, 0}, {10, 0, 0}));
  EXPECT_THAT(crossings({from, lane(2, straight({46, 0, 0}, {50, 0, 0}))}), IsEmpty());
  EXPECT_THAT(crossings({from, lane(2, straight({30, 2, 0}, {40, 2, 0}))}), IsEmpty());
  EXPECT_THAT(crossings({from, lane(2, straight({30, 0, 0}, {40, 6, 0}))}), IsEmpty());
  EXPECT_THAT(crossings({from, lane(2, straight({40, 0, 0}, {30, 0, 0}))}), IsEmpty());
  LinkageConfig never;
  never.straight_across = false;
  EXPECT_THAT(crossings({from, lane(2, straight({30, 0, 0}, {40, 0, 0}))}, {}, never), IsEmpty());
}

TEST(Crossings, LeadUpAndDownButNotOntoABridge) {
  const auto from_road_to = [](double z) {
    return crossings({lane(1, straight({0, 0, 0}, {10, 0, 0})), lane(2, straight({40, 0, z}, {50, 0, z}))});
  };
  EXPECT_EQ(from_road_to(3.5).size(), 1U);
  EXPECT_EQ(from_road_to(-3.5).size(), 1U);
  EXPECT_THAT(from_road_to(5.0), IsEmpty());
  EXPECT_THAT(from_road_to(-5.0), IsEmpty());
}

TEST(Crossings, LanesThatMarkingsLinkAreLeftAlone) {
  const std::vector<Lane> lanes{lane(1, straight({0, 0, 0}, {10, 0, 0})),
                                lane(2, straight({11, 0, 0}, {18, 0, 0})),
                                lane(3, straight({30, 0, 0}, {40, 0, 0}))};
  const auto linkages = crossings(lanes, {{.from = 1, .to = 2}});
  EXPECT_THAT(pairs(linkages), ElementsAre(Pair(1, 2), Pair(2, 3)));
}

TEST(Crossings, AtACrossroadsEveryWayLeadsStraightLeftAndRight) {
  const auto linkages = crossings(crossroads());
  using Turn = Linkage::Turn;
  EXPECT_THAT(pairs_of(linkages, Turn::straight),
              ElementsAre(Pair(1, 13), Pair(2, 14), Pair(3, 11), Pair(4, 12)));
  EXPECT_THAT(pairs_of(linkages, Turn::left),
              ElementsAre(Pair(1, 14), Pair(2, 11), Pair(3, 12), Pair(4, 13)));
  EXPECT_THAT(pairs_of(linkages, Turn::right),
              ElementsAre(Pair(1, 12), Pair(2, 13), Pair(3, 14), Pair(4, 11)));
  EXPECT_EQ(linkages.size(), 12U);
}

TEST(Crossings, AKerbThatLeadsRoundTheCornerLeavesTheOtherWays) {
  const auto linkages = crossings(crossroads(), {{.from = 1, .to = 12}});
  EXPECT_THAT(pairs_of(linkages, Linkage::Turn::right),
              ElementsAre(Pair(1, 12), Pair(2, 13), Pair(3, 14), Pair(4, 11)));
  EXPECT_EQ(std::ranges::count(linkages, Linkage::Kind::shared_boundary, &Linkage::kind), 1);
  EXPECT_EQ(linkages.size(), 12U);
}

TEST(Crossings, ATurnGoesStraightOnFirstWhereTheCornerIsFar) {
  // 20 m ahead and 6 m to the right: the turn begins at most a quarter further from the corner than it ends.
  const auto linkages = crossings({driven(1, {-20, 0, 0}, {0, 0, 0}), driven(2, {20, -6, 1}, {20, -20, 1})});
  ASSERT_EQ(linkages.size(), 1U);
  const Polyline& path = linkages[0].path;
  EXPECT_TRUE(path.front().isApprox(Point(0, 0, 0)));
  EXPECT_TRUE(path.back().isApprox(Point(20, -6, 1)));
  const MeasuredPolyline measured(path);
  for (double x = 1.0; x < 12.0; x += 1.0) EXPECT_NEAR(measured.project({x, 0, 0}).distance_m, 0.0, 1e-6);
  EXPECT_GT(measured.project({13, 0, 0}).distance_m, 0.02);
}

TEST(Crossings, ATurnOfAQuarterIsAnArc) {
  const auto linkages = crossings({driven(1, {-20, 0, 0}, {0, 0, 0}), driven(2, {8, -8, 0}, {8, -20, 0})});
  ASSERT_EQ(linkages.size(), 1U);
  const Eigen::Vector2d center(0, -8);
  for (const Point& p : linkages[0].path) EXPECT_NEAR((p.head<2>() - center).norm(), 8.0, 0.1);
}

/// Streets along the crossroads' arms, meeting at node 5.
SdMap streets(bool east_is_oneway_in = false, const std::vector<SdRestriction>& restrictions = {}) {
  const auto arm = [](std::int64_t id, const Eigen::Vector2d& end) {
    return SdWay{.id = id, .nodes = {id, 5}, .points = {end, {0, 0}}};
  };
  std::vector<SdWay> ways{arm(1, {-60, 0}), arm(2, {0, -60}), arm(3, {60, 0}), arm(4, {0, 60})};
  ways[2].oneway = east_is_oneway_in;
  return {std::move(ways), restrictions};
}

TEST(Crossings, AnSdMapConfirmsThem) {
  const auto linkages = crossings(crossroads(), {}, {}, {}, streets());
  EXPECT_EQ(linkages.size(), 12U);
  for (const Linkage& l : linkages) {
    EXPECT_EQ(l.kind, Linkage::Kind::sd_map);
    EXPECT_GT(l.probability, 0.9);
    EXPECT_TRUE(overlap(l.evidence, Evidence::sd_map));
  }
}

TEST(Crossings, AnSdMapForbidsThem) {
  const auto no_left =
      crossings(crossroads(), {}, {}, {}, streets(false, {{.from_way = 1, .via_node = 5, .to_way = 4}}));
  EXPECT_THAT(pairs_of(no_left, Linkage::Turn::left), ElementsAre(Pair(2, 11), Pair(3, 12), Pair(4, 13)));
  EXPECT_EQ(no_left.size(), 11U);
}

TEST(Crossings, AnSdMapSuppliesWaysBetweenLanesThatLieIrregularly) {
  // 40 degrees to the left: neither straight on nor a turn.
  const double s = std::sin(40 * std::numbers::pi / 180), c = std::cos(40 * std::numbers::pi / 180);
  const std::vector<Lane> lanes{driven(1, {-20, 0, 0}, {-8, 0, 0}),
                                driven(2, {8 * c, 8 * s, 0}, {20 * c, 20 * s, 0})};
  EXPECT_THAT(crossings(lanes), IsEmpty());
  const SdMap street({{.id = 1, .nodes = {1, 2, 3}, .points = {{-60, 0}, {0, 0}, {60 * c, 60 * s}}}}, {});
  const auto linkages = crossings(lanes, {}, {}, {}, street);
  ASSERT_EQ(linkages.size(), 1U);
  EXPECT_EQ(linkages[0].kind, Linkage::Kind::sd_map);
}

TEST(Crossings, TurnsAskForKnownDirections) {
  std::vector<Lane> lanes = crossroads();
  for (Lane& l : lanes) l.direction = Lane::Direction::unknown;
  for (const Linkage& l : crossings(lanes)) EXPECT_EQ(l.turn, Linkage::Turn::straight);
}

TEST(Crossings, StraightOnTheDirectionIsKept) {
  std::vector<Lane> lanes{driven(1, {0, 0, 0}, {10, 0, 0}), lane(2, straight({30, 0, 0}, {40, 0, 0})),
                          lane(3, straight({30, 20, 0}, {40, 20, 0}))};
  RoadGraph road{{{}, lanes}, {}};
  link_across_intersections({}, {}, road);
  EXPECT_EQ(road.lanes[1].direction, Lane::Direction::along_centerline);
  EXPECT_EQ(road.lanes[2].direction, Lane::Direction::unknown);
}

TEST(Crossings, ALaneBetweenSolidLinesTakesNoDirectionFromStraightOn) {
  std::vector<Lane> lanes{driven(1, {0, 0, 0}, {10, 0, 0}), lane(2, straight({30, 0, 0}, {40, 0, 0}))};
  std::vector<boundaries::LaneBoundary> boundaries;
  for (const ElementId id : {21U, 22U}) {
    const double y = id == 21U ? 1.75 : -1.75;
    boundaries.push_back(test::boundary(id, straight({30, y, 0}, {40, y, 0})));
    boundaries.back().marking.styles = {{{0.0, 10.0}, MarkingStyle::solid}};
  }
  lanes[1].left_borders = {{.boundary = 21}}, lanes[1].right_borders = {{.boundary = 22}};
  lanes[1].left_borders.front().on_boundary = lanes[1].right_borders.front().on_boundary = {0.0, 10.0};
  lanes[1].left_neighbours = lanes[1].right_neighbours = {{.lane = 9, .range = {0.0, 10.0}}};
  RoadGraph road{{boundaries, lanes}, {}};
  link_across_intersections({}, {}, road);
  EXPECT_EQ(road.linkages.size(), 1U);
  EXPECT_EQ(road.lanes[1].direction, Lane::Direction::unknown);
}

TEST(Crossings, AheadOfAKnownLaneAnUnknownOneIsTurnedWithWhatItIsLinkedTo) {
  std::vector<Lane> lanes{driven(1, {-30, 0, 0}, {-10, 0, 0}), lane(2, straight({30, 0, 0}, {10, 0, 0})),
                          lane(3, straight({50, 0, 0}, {30, 0, 0}))};
  RoadGraph road{{{}, lanes}, {{.from = 3, .to = 2}}};
  link_across_intersections({}, {}, road);
  EXPECT_THAT(pairs_of(road.linkages, Linkage::Turn::straight), ElementsAre(Pair(1, 2)));
  EXPECT_EQ(road.lanes[1].centerline.front().x(), 10.0);
  EXPECT_EQ(road.lanes[2].centerline.front().x(), 30.0);
  EXPECT_EQ(std::ranges::count(road.linkages, 2U, &Linkage::from), 1);  // on into 3
  EXPECT_EQ(road.lanes[1].direction, Lane::Direction::along_centerline);
}

TEST(Crossings, TurnsLeadFromTheOutermostLane) {
  // Two lanes from the west; the left one is 1, the right one 5.
  std::vector<Lane> lanes = crossroads();
  lanes.push_back(driven(5, {-25, -5.25, 0}, {-10, -5.25, 0}));
  lanes[0].right_neighbours = {{.lane = 5, .range = {0.0, 20.0}}};
  lanes.back().left_neighbours = {{.lane = 1, .range = {0.0, 20.0}}};
  const auto linkages = crossings(lanes);
  EXPECT_THAT(pairs_of(linkages, Linkage::Turn::left), ::testing::Contains(Pair(1, 14)));
  EXPECT_THAT(pairs_of(linkages, Linkage::Turn::right), ::testing::Contains(Pair(5, 12)));
  EXPECT_THAT(pairs_of(linkages, Linkage::Turn::left), ::testing::Not(::testing::Contains(Pair(5, 14))));
  EXPECT_THAT(pairs_of(linkages, Linkage::Turn::right), ::testing::Not(::testing::Contains(Pair(1, 12))));
}

/// Whether 1 turns left into 14, where one more lane of that direction is between this and the way in.
bool turns_past(Direction direction, MarkingStyle divider) {
  std::vector<Lane> lanes = crossroads();
  const auto get = [&](ElementId id) -> Lane& { return *std::ranges::find(lanes, id, &Lane::id); };
  get(4).centerline = straight({-5.25, 25, 0}, {-5.25, 10, 0});
  get(4).left_neighbours = {{.lane = 24, .range = {0.0, 20.0}}};
  get(4).left_borders = {{.boundary = 51}};
  get(4).left_borders.front().on_boundary = {0, 15};
  get(14).centerline = straight({1.75, 10, 0}, {1.75, 25, 0});
  get(14).left_neighbours = {{.lane = 24, .range = {0.0, 20.0}}};
  get(14).left_borders = {{.boundary = 50}};
  get(14).left_borders.front().on_boundary = {0, 15};
  lanes.push_back(lane(24, straight({-1.75, 10, 0}, {-1.75, 25, 0})));
  lanes.back().direction = direction;
  lanes.back().left_neighbours = {{.lane = 4, .range = {0.0, 20.0}}};
  lanes.back().right_neighbours = {{.lane = 14, .range = {0.0, 20.0}}};
  std::vector<boundaries::LaneBoundary> boundaries{
      test::boundary(50, straight({0, 10, 0}, {0, 25, 0})),
      test::boundary(51, straight({-3.5, 25, 0}, {-3.5, 10, 0}))};
  boundaries[0].marking.styles = {{{0, 15}, divider}};
  const auto left = pairs_of(crossings(lanes, {}, {}, boundaries), Linkage::Turn::left);
  return std::ranges::count(left, Pair(1, 14)) > 0;
}

TEST(Crossings, ALaneOfUnknownDirectionStandsBetweenOnlyAcrossDashes) {
  EXPECT_TRUE(turns_past(Direction::unknown, MarkingStyle::solid));
  EXPECT_TRUE(turns_past(Direction::unknown, MarkingStyle::unknown));
  EXPECT_FALSE(turns_past(Direction::unknown, MarkingStyle::dashed));
  EXPECT_FALSE(turns_past(Direction::along_centerline, MarkingStyle::solid));
}

TEST(Crossings, TurnsArePossibleWhereAnEdgeIsOnlyContinued) {
  std::vector<Lane> lanes = crossroads();
  lanes.front().right_borders = {{.boundary = 50}};
  const std::vector<Linkage> straight_on{{.from = 1, .to = 13}};
  std::vector<boundaries::LaneBoundary> edge{
      test::boundary(50, straight({-25, -4, 0}, {-10, -4, 0}), MarkingType::roadedge)};
  EXPECT_THAT(pairs_of(crossings(lanes, straight_on, {}, edge), Linkage::Turn::right),
              Not(Contains(Pair(1, 12))));
  edge.front().marking.status = ElementStatus::inferred;
  EXPECT_THAT(pairs_of(crossings(lanes, straight_on, {}, edge), Linkage::Turn::right), Contains(Pair(1, 12)));
}

TEST(Crossings, NoWayLeadsOverAnEdge) {
  const std::vector<boundaries::LaneBoundary> corner{
      test::boundary(50, test::arc({-10, -10, 0}, 7.0, 0, 90), MarkingType::roadedge)};
  EXPECT_THAT(pairs_of(crossings(crossroads(), {}, {}, corner), Linkage::Turn::right),
              ElementsAre(Pair(1, 12), Pair(2, 13), Pair(3, 14), Pair(4, 11)));
  const std::vector<boundaries::LaneBoundary> flyover{
      test::boundary(50, straight({-9, -9, 6}, {0, 0, 6}), MarkingType::roadedge)};
  EXPECT_EQ(crossings(crossroads(), {}, {}, flyover).size(), crossings(crossroads()).size());
  std::vector<boundaries::LaneBoundary> island{
      test::boundary(50, straight({-9, -9, 0}, {0, 0, 0}), MarkingType::roadedge)};
  EXPECT_THAT(pairs_of(crossings(crossroads(), {}, {}, island), Linkage::Turn::right),
              ElementsAre(Pair(2, 13), Pair(3, 14), Pair(4, 11)));
  // One that nobody saw may be the mouth of a street.
  island.front().marking.status = ElementStatus::inferred;
  EXPECT_EQ(crossings(crossroads(), {}, {}, island).size(), crossings(crossroads()).size());
}

TEST(Crossings, NoTurnIsTooTightOrTooWide) {
  const Lane from = driven(1, {-25, 0, 0}, {-10, 0, 0});
  EXPECT_THAT(crossings({from, driven(2, {-8, 2, 0}, {-8, 20, 0})}), IsEmpty());
  EXPECT_THAT(crossings({from, driven(2, {0, 40, 0}, {0, 60, 0})}), IsEmpty());
  EXPECT_THAT(crossings({from, driven(2, {0, -10, 0}, {0, 10, 0})}), IsEmpty());  // passes the corner
  EXPECT_EQ(crossings({from, driven(2, {0, 10, 0}, {0, 20, 0})}).size(), 1U);
}

}  // namespace
}  // namespace laneloom::topology
