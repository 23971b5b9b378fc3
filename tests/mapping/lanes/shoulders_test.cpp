#include "mapping/lanes/shoulders.hpp"

#include <gmock/gmock.h>

#include "mapping/boundaries/road_sections.hpp"
#include "mapping/lanes/lanes.hpp"
#include "mapping/shapes.hpp"

namespace laneloom::lanes {
namespace {

using test::boundary;
using test::straight;

/// A strip of a street of 40 m along x, whose strips run from left to right: a boundary, and what lies on its
/// right.
struct Strip {
  MarkingType type;
  MarkingStyle style;
  double width_m;
};

constexpr Strip edge(double width_m) { return {MarkingType::roadedge, MarkingStyle::unknown, width_m}; }
constexpr Strip solid(double width_m) { return {MarkingType::laneline, MarkingStyle::solid, width_m}; }
constexpr Strip dashed(double width_m) { return {MarkingType::laneline, MarkingStyle::dashed, width_m}; }

/// The widths of the lanes that are left, in no order.
std::vector<double> lane_widths(const std::vector<Strip>& strips, const LaneConfig& config = {},
                                const Eigen::Isometry3d& T_map_body = test::at(0, -20)) {
  std::vector<boundaries::LaneBoundary> boundaries;
  double y = 10.0;
  for (const Strip& strip : strips) {
    boundaries.push_back(boundary(boundaries.size() + 1, straight({0, y, 0}, {40, y, 0}), strip.type));
    boundaries.back().marking.styles = {{{0, 40}, strip.style}};
    y -= strip.width_m;
  }
  const auto graph = road_sections(boundaries, test::at(0), {});
  const auto pairs = boundary_pairs(graph);
  const auto lanes = generate_lanes(pairs, graph.boundaries, Point::Zero(), config);
  std::vector<double> widths;
  for (const Lane& lane : without_shoulders(lanes, pairs, graph.boundaries, T_map_body, config))
    widths.push_back(lane.width_m);
  return widths;
}

auto are(std::vector<double> widths) {
  std::vector<::testing::Matcher<double>> near;
  near.reserve(widths.size());
  for (const double width : widths) near.push_back(::testing::DoubleNear(width, 1e-6));
  return ::testing::UnorderedElementsAreArray(near);
}

TEST(Shoulders, AreNoLanes) {
  EXPECT_THAT(lane_widths({solid(3.5), solid(2.6), edge(0)}), are({3.5}));
  EXPECT_THAT(lane_widths({edge(2.5), solid(3.5), dashed(3.4), solid(2.6), edge(0)}), are({3.5, 3.4}));
}

TEST(Shoulders, LieBesideASolidLine) {
  EXPECT_THAT(lane_widths({dashed(3.5), solid(2.6), edge(0)}), are({3.5}));
  EXPECT_THAT(lane_widths({dashed(3.5), dashed(2.6), edge(0)}), are({3.5, 2.6}));
}

TEST(Shoulders, ANarrowRoadOfTwoLanesHasNone) {
  EXPECT_THAT(lane_widths({edge(3.3), solid(2.6), edge(0)}), are({3.3, 2.6}));
  // Nor where a line is painted along an edge.
  EXPECT_THAT(lane_widths({edge(0.5), solid(3.3), solid(2.6), edge(0)}), are({3.3, 2.6}));
}

TEST(Shoulders, AreNarrowAndNarrowerThanTheLane) {
  EXPECT_THAT(lane_widths({solid(3.5), solid(3.1), edge(0)}), are({3.5, 3.1}));
  EXPECT_THAT(lane_widths({solid(2.8), solid(2.7), edge(0)}), are({2.8, 2.7}));
}

TEST(Shoulders, AreBesideALane) { EXPECT_THAT(lane_widths({solid(2.6), edge(0)}), are({2.6})); }

TEST(Shoulders, AreNotWhereTheVehicleDrives) {
  EXPECT_THAT(lane_widths({solid(3.5), solid(2.6), edge(0)}, {}, test::at(20, 10 - 3.5 - 1.3)),
              are({3.5, 2.6}));
  EXPECT_THAT(lane_widths({solid(3.5), solid(2.6), edge(0)}, {}, test::at(20, 10 - 1.7)), are({3.5}));
}

TEST(Shoulders, AreNotAheadOfWhereTheVehicleDrives) {
  // In a bay of the edge there is no lane beside the line.
  std::vector<boundaries::LaneBoundary> boundaries{
      boundary(1, straight({0, 6.1, 0}, {40, 6.1, 0})), boundary(2, straight({0, 2.6, 0}, {40, 2.6, 0})),
      boundary(3, {{0, 0, 0}, {16, 0, 0}, {18, -6, 0}, {22, -6, 0}, {24, 0, 0}, {40, 0, 0}},
               MarkingType::roadedge)};
  boundaries[1].marking.styles = {{{0, 40}, MarkingStyle::solid}};
  const auto graph = road_sections(boundaries, test::at(0), {});
  const auto pairs = boundary_pairs(graph);
  const auto pieces = [&](const Eigen::Isometry3d& T_map_body) {
    const auto lanes = without_shoulders(generate_lanes(pairs, graph.boundaries, Point::Zero(), {}), pairs,
                                         graph.boundaries, T_map_body, {});
    return std::ranges::count(lanes, 3U,
                              [](const Lane& lane) { return lane.right_borders.front().boundary; });
  };
  EXPECT_EQ(pieces(test::at(5, 1.3)), 2);
  EXPECT_EQ(pieces(test::at(5, 4.3)), 0);
}

TEST(Shoulders, AreLanesWhereThatIsConfigured) {
  EXPECT_THAT(lane_widths({solid(3.5), solid(2.6), edge(0)}, {.find_shoulders = false}), are({3.5, 2.6}));
}

}  // namespace
}  // namespace laneloom::lanes
