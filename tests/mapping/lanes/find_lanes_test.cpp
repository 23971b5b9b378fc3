#include "mapping/lanes/find_lanes.hpp"

#include <gmock/gmock.h>

#include "mapping/boundaries/road_sections.hpp"
#include "mapping/shapes.hpp"

namespace laneloom::lanes {
namespace {

using test::boundary;
using test::straight;
using testing::DoubleNear;
using testing::IsEmpty;

/// A strip of a road of 30 m along x. The strips lie from left to right: a boundary, and the width on its
/// right.
struct Across {
  MarkingType type;
  MarkingStyle style;
  double width_m;
};

constexpr Across edge(double width_m) { return {MarkingType::roadedge, MarkingStyle::unknown, width_m}; }
constexpr Across solid(double width_m) { return {MarkingType::laneline, MarkingStyle::solid, width_m}; }
constexpr Across dashed(double width_m) { return {MarkingType::laneline, MarkingStyle::dashed, width_m}; }

constexpr double kLeft_m = 8.0;       // of the first boundary
constexpr double kNowhere_m = 100.0;  // beside the road

std::vector<boundaries::LaneBoundary> road(const std::vector<Across>& strips) {
  std::vector<boundaries::LaneBoundary> boundaries;
  double y = kLeft_m;
  for (const Across& strip : strips) {
    boundaries.push_back(boundary(boundaries.size() + 1, straight({0, y, 0}, {30, y, 0}), strip.type));
    boundaries.back().marking.styles = {{{0, 30}, strip.style}};
    y -= strip.width_m;
  }
  return boundaries;
}

FoundLanes find(std::vector<boundaries::LaneBoundary> boundaries, double vehicle_y = kNowhere_m,
                const LaneConfig& config = {}) {
  const Eigen::Isometry3d vehicle = test::at(10, vehicle_y);
  return find_lanes(road_sections(std::move(boundaries), test::at(0), {}), test::scene(1).box,
                    {{&vehicle, 1}, {}}, {}, config);
}

std::vector<double> widths(const FoundLanes& found) {
  std::vector<double> widths;
  for (const Lane& lane : found.lanes) widths.push_back(lane.width_m);
  return widths;
}
std::vector<double> widths(const std::vector<Across>& strips, double vehicle_y = kNowhere_m,
                           const LaneConfig& config = {}) {
  return widths(find(road(strips), vehicle_y, config));
}

auto are(std::vector<double> widths) {
  std::vector<testing::Matcher<double>> near;
  near.reserve(widths.size());
  for (const double width : widths) near.push_back(DoubleNear(width, 1e-6));
  return testing::UnorderedElementsAreArray(near);
}

TEST(FindLanes, BetweenLines) {
  const FoundLanes found = find(road({solid(3.5), dashed(3.4), solid(0)}));
  EXPECT_THAT(widths(found), are({3.5, 3.4}));
  EXPECT_THAT(found.inferred, IsEmpty());
  EXPECT_NEAR(length(found.lanes.front().centerline), 30.0, 1e-9);
}

TEST(FindLanes, NeverAcrossALineThatIsBelieved) {
  EXPECT_THAT(widths({solid(2.3), dashed(2.3), solid(0)}),
              testing::Not(testing::Contains(DoubleNear(4.6, 0.1))));
  EXPECT_THAT(widths({edge(3.0), dashed(3.0), edge(0)}), are({3.0, 3.0}));
}

TEST(FindLanes, ShouldersAreNone) {
  EXPECT_THAT(widths({edge(2.5), solid(3.5), dashed(3.4), solid(2.6), edge(0)}), are({3.5, 3.4}));
  LaneConfig config;
  config.find_side_strips = false;
  EXPECT_THAT(widths({edge(2.5), solid(3.5), dashed(3.4), solid(2.6), edge(0)}, kNowhere_m, config),
              testing::Contains(DoubleNear(2.6, 1e-6)));
}

TEST(FindLanes, AStripIsAShoulderWhereThatIsLikelierThanALane) {
  EXPECT_THAT(widths({edge(2.8), solid(3.5), dashed(3.4), solid(0)}), are({3.5, 3.4}));
  EXPECT_THAT(widths({edge(3.1), solid(3.5), dashed(3.4), solid(0)}), are({3.1, 3.5, 3.4}));
  const FoundLanes found = find(road({edge(2.0), solid(3.5), dashed(3.4), solid(0)}));
  ASSERT_EQ(found.side_strips.size(), 1U);
  EXPECT_EQ(found.side_strips.front().use, Lane::Use::shoulder);
  EXPECT_NEAR(found.side_strips.front().width_m, 2.0, 1e-6);
}

TEST(FindLanes, AKnownLaneIsDeniedWhereItsBordersTellOfNone) {
  const auto denied = [](const KnownBorders& known) {
    const Eigen::Isometry3d vehicle = test::at(10, kNowhere_m);
    return find_lanes(road_sections(road({edge(2.3), solid(3.5), dashed(3.4), solid(0)}), test::at(0), {}),
                      test::scene(1).box, {{&vehicle, 1}, {}}, {known}, {})
        .denied;
  };
  EXPECT_THAT(denied({}), IsEmpty()) << "a shoulder that never was a lane";
  EXPECT_THAT(denied({{2, 3}}), IsEmpty()) << "a lane";
  for (const KnownBorders& shoulder : {KnownBorders{{1, 2}}, KnownBorders{{2, 1}}}) {
    const auto found = denied(shoulder);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(length(found.front().middle), 30.0, 1e-6);
    EXPECT_NEAR(found.front().middle.front().y(), kLeft_m - 1.15, 1e-6);
  }
}

TEST(FindLanes, TheSdMapTellsHowManyLanesAStreetHas) {
  const auto found = [](const std::vector<Across>& strips, int lanes) {
    const SdMap sd_map({{.id = 1, .nodes = {1, 2}, .points = {{-50, 2}, {80, 2}}, .lanes = lanes}}, {});
    const Eigen::Isometry3d vehicle = test::at(10, kLeft_m - 2.5);
    return find_lanes(road_sections(road(strips), test::at(0), {}), test::scene(1).box, {{&vehicle, 1}, {}},
                      {{}, &sd_map}, {});
  };
  const std::vector<Across> street{edge(6.2), edge(0)};
  EXPECT_THAT(widths(found(street, 1)), are({6.2}));
  EXPECT_THAT(widths(found(street, 2)), IsEmpty());
  EXPECT_EQ(found(street, 2).inferred.size(), 1U) << "the border between two lanes";
  // The lanes of a street with a line: how many are on either side of that?
  const std::vector<Across> half{edge(6.2), dashed(3.1), edge(0)};
  EXPECT_THAT(widths(found(half, 2)), are({6.2, 3.1}));
  EXPECT_THAT(widths(found(half, 3)), are({3.1}));
}

TEST(FindLanes, AMedianIsNone) {
  EXPECT_THAT(widths({dashed(3.5), solid(1.5), solid(3.5), dashed(0)}), are({3.5, 3.5}));
}

TEST(FindLanes, AGoreIsNone) {
  auto lines = road({solid(3.5), solid(3.5), solid(0)});
  lines.push_back(boundary(4, {{0, 1.2, 0}, {30, -4.8, 0}}));  // meets the right line, and leaves it
  lines.back().marking.styles = {{{0, 30}, MarkingStyle::solid}};
  for (const Lane& lane : find(lines).lanes)
    EXPECT_FALSE(lane.left_borders.front().boundary == 3U && lane.right_borders.front().boundary == 4U);
}

TEST(FindLanes, AVergeBesideARoadIsNoneUnlessTheVehicleDrivesThere) {
  const std::vector<Across> strips{edge(3.0), edge(3.5), dashed(3.5), edge(0)};
  EXPECT_THAT(widths(strips), are({3.5, 3.5}));
  EXPECT_THAT(widths({edge(3.0), edge(0)}, kLeft_m - 1.5), are({3.0}));
}

TEST(FindLanes, NarrowOnesAreFoundWhereThatIsConfigured) {
  EXPECT_THAT(widths({solid(1.4), dashed(1.4), solid(0)}), IsEmpty());
  LaneConfig config;
  config.min_width_m = 1.2;
  EXPECT_THAT(widths({solid(1.4), dashed(1.4), solid(0)}, kNowhere_m, config), are({1.4, 1.4}));
}

TEST(FindLanes, ALaneAcrossBoundariesThatRunAgainstEachOtherIsFoundOnce) {
  auto lines = road({solid(3.5), solid(0)});
  std::ranges::reverse(lines.back().marking.points);
  EXPECT_THAT(widths(find(lines)), are({3.5}));
}

TEST(FindLanes, ALaneBetweenOpposedBoundariesThatAreRightOfEachOtherIsFoundOnce) {
  auto lines = road({dashed(3.5), edge(0)});
  std::ranges::reverse(lines.back().marking.points);
  // Sections are turned so that this is rare: where streets meet, not all of one can be turned alike.
  boundaries::SectionGraph graph = road_sections(lines, test::at(0), {});
  for (const std::size_t i : {0U, 1U}) {
    if ((graph.boundaries[i].course.at(0.0).x() < 1.0) == (i == 0)) continue;
    graph.boundaries.reverse(i);
    for (boundaries::SideBySide& beside : graph.beside[i]) beside.lateral_m = -beside.lateral_m;
    for (const std::size_t k : {0U, 1U}) graph.beside[k].front().opposed = !graph.beside[k].front().opposed;
  }
  ASSERT_TRUE(graph.beside[0].front().opposed);
  ASSERT_LT(graph.beside[0].front().lateral_m, 0.0);
  ASSERT_LT(graph.beside[1].front().lateral_m, 0.0);
  const FoundLanes found = find_lanes(graph, test::scene(1).box, {}, {}, {});
  ASSERT_THAT(widths(found), are({3.5}));
  const Lane& lane = found.lanes.front();
  EXPECT_LT(lane.centerline.back().x(), lane.centerline.front().x());
  EXPECT_GT(lane.left.front().x(), 29.0);
  EXPECT_LT(lane.left.front().y(), lane.right.front().y()) << "the lane runs along -x";
  EXPECT_TRUE(lane.right_borders.front().reversed);
  EXPECT_FALSE(lane.left_borders.front().reversed);
}

TEST(FindLanes, ALineThatEndsGoesOnUnseen) {
  // Of two lanes beside an edge, 2.9 m each, the line between them ends half-way.
  auto lines = road({dashed(2.9), dashed(2.9), edge(0)});
  lines[1].marking.points = {{0, kLeft_m - 2.9, 0}, {12, kLeft_m - 2.9, 0}};
  lines[1] = boundary(2, lines[1].marking.points, MarkingType::laneline);
  lines[1].marking.styles = {{{0, 12}, MarkingStyle::dashed}};
  for (const Lane& lane : find(lines).lanes) EXPECT_LT(lane.width_m, 3.5);
}

TEST(FindLanes, OfADoubleLineTheNearerOneIsTheBorder) {
  EXPECT_THAT(widths({dashed(3.5), solid(0.24), solid(3.5), dashed(0)}), are({3.5, 3.5}));
}

TEST(FindLanes, EndWhereTheRoadWidensToASquare) {
  auto lines = road({solid(3.5)});
  lines.push_back(boundary(2, {{0, 4.5, 0}, {15, 4.5, 0}, {30, -10, 0}}));
  const FoundLanes found = find(lines);
  ASSERT_EQ(found.lanes.size(), 1U);
  EXPECT_LT(found.lanes.front().centerline.back().x(), 18.0);
}

TEST(FindLanes, OpenLanesLieBesideDashes) {
  const FoundLanes found = find(road({dashed(0)}), kLeft_m - 1.6);
  ASSERT_EQ(found.inferred.size(), 2U);
  for (const InferredBoundary& one : found.inferred)
    EXPECT_NEAR(std::abs(one.marking.points.front().y() - kLeft_m), LaneConfig{}.assumed_width_m, 1e-6);
}

TEST(FindLanes, OpenLanesLieBesideAnEdgeOnlyWhereTheVehicleDrives) {
  EXPECT_THAT(find(road({edge(0)})).inferred, IsEmpty());
  EXPECT_EQ(find(road({edge(0)}), kLeft_m - 1.6).inferred.size(), 1U);
  LaneConfig config;
  config.one_sided_lanes = false;
  EXPECT_THAT(find(road({edge(0)}), kLeft_m - 1.6, config).inferred, IsEmpty());
}

TEST(FindLanes, OpenLanesAreNotWhereLanesHaveBothBorders) {
  EXPECT_THAT(find(road({solid(3.5), dashed(3.5), solid(0)}), kLeft_m - 1.7).inferred, IsEmpty());
}

/// The widths of the lanes between a line and a kerb, from left to right, as the vehicle drove so far beside
/// the line.
std::vector<double> divided(const std::vector<Across>& strips, double beside_m, double driven_m) {
  const Polyline way = straight({0, kLeft_m - beside_m, 0}, {driven_m, kLeft_m - beside_m, 0},
                                static_cast<int>(driven_m / 2.0) + 1);
  const Eigen::Isometry3d vehicle = test::at(driven_m, kLeft_m - beside_m);
  const FoundLanes found = find_lanes(road_sections(road(strips), test::at(0), {}), test::scene(1).box,
                                      {{&vehicle, 1}, way}, {}, {});
  for (const InferredBoundary& divider : found.inferred)
    if (divider.on_left && divider.on_right)
      return {divider.on_left->sections.front().width_m, divider.on_right->sections.front().width_m};
  return {};
}

TEST(FindLanes, TheVehicleTellsHowWideItsLaneBesideALineIs) {
  const auto are_in_order = [](double left_m, double right_m) {
    return testing::ElementsAre(testing::DoubleNear(left_m, 1e-6), testing::DoubleNear(right_m, 1e-6));
  };
  const std::vector<Across> parking{solid(7.6), edge(0)};
  EXPECT_THAT(divided(parking, 1.6, 20.0), are_in_order(3.2, 4.4));
  EXPECT_THAT(divided({edge(7.6), solid(0)}, 6.0, 20.0), are_in_order(4.4, 3.2));
  EXPECT_THAT(divided(parking, 1.6, 8.0), are_in_order(3.8, 3.8));   // too short a way
  EXPECT_THAT(divided(parking, 5.4, 20.0), are_in_order(3.8, 3.8));  // beside the kerb, where cars park
  EXPECT_THAT(divided({edge(7.6), edge(0)}, 1.6, 20.0), are_in_order(3.8, 3.8));  // a street
}

TEST(FindLanes, DividedRoadsCanBeTurnedOff) {
  EXPECT_EQ(find(road({edge(7.2), edge(0)})).inferred.size(), 1U);
  LaneConfig config;
  config.unmarked_roads = false;
  for (const InferredBoundary& one : find(road({edge(7.2), edge(0)}), kNowhere_m, config).inferred)
    EXPECT_FALSE(one.on_left && one.on_right);
}

TEST(FindLanes, ThePapersMethodInfersNothing) {
  LaneConfig config;
  config.method = LaneMethod::paper;
  const FoundLanes found = find(road({edge(7.2), edge(0)}), kNowhere_m, config);
  EXPECT_THAT(found.lanes, IsEmpty());
  EXPECT_THAT(found.inferred, IsEmpty());
}

/// Streets between two edges in which the vehicle drives, by their widths.
class Street : public testing::TestWithParam<double> {};

TEST_P(Street, OfEachWidthHasOneLaneOrTwo) {
  const double width_m = GetParam();
  const FoundLanes found = find(road({edge(width_m), edge(0)}), kLeft_m - 0.7 * width_m);
  if (width_m < 5.5) {
    EXPECT_THAT(widths(found), are({width_m}));
    EXPECT_THAT(found.inferred, IsEmpty());
  } else {
    EXPECT_EQ(found.lanes.size() + found.inferred.size(), 1U);
  }
  if (width_m < LaneConfig{}.min_divided_width_m) return;
  ASSERT_EQ(found.inferred.size(), 1U);
  EXPECT_TRUE(found.inferred.front().on_left && found.inferred.front().on_right);
}

INSTANTIATE_TEST_SUITE_P(Widths, Street,
                         testing::Values(2.4, 2.8, 3.2, 3.6, 4.0, 4.4, 4.8, 5.2, 5.6, 6.0, 6.2, 6.4, 6.6, 7.0,
                                         8.0, 9.0, 10.0, 11.0, 12.0, 12.8));

}  // namespace
}  // namespace laneloom::lanes
