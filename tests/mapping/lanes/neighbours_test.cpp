#include "mapping/lanes/neighbours.hpp"

#include <gmock/gmock.h>

#include "mapping/shapes.hpp"

namespace laneloom::lanes {
namespace {

using test::straight;
using ::testing::ElementsAre;

Border along(ElementId boundary, double from_x, double to_x) {
  return {boundary, {from_x, to_x}, {from_x, to_x}};
}

std::pair<double, double> ends(const Stretch& range) { return {range.from_m, range.to_m}; }

/// Lane 1 has lane 2 on its left, behind boundary 7 up to 20 m, nothing that is seen up to 30 m, and boundary
/// 8 from there on.
LaneLayout lanes_side_by_side() {
  Lane right = test::lane(1, {0, 0, 0}, {50, 0, 0}), left = test::lane(2, {0, 3.5, 0}, {50, 3.5, 0});
  const Border behind{8, {30, 50}, {0, 20}};
  right.left_borders = {along(7, 0, 20), {kNoElement, {20, 30}, {}}, behind};
  right.right_borders = {along(6, 0, 50)};
  left.left_borders = {along(9, 0, 50)};
  left.right_borders = right.left_borders;
  boundaries::LaneBoundary dashed = test::boundary(8, straight({30, 1.75, 0}, {50, 1.75, 0}));
  dashed.marking.styles = {{{0, 5}, MarkingStyle::solid}, {{5, 20}, MarkingStyle::dashed}};
  return {.boundaries = std::vector{test::boundary(6, straight({0, -1.75, 0}, {50, -1.75, 0})),
                                    test::boundary(7, straight({0, 1.75, 0}, {20, 1.75, 0})), dashed,
                                    test::boundary(9, straight({0, 5.25, 0}, {50, 5.25, 0}))},
          .lanes = {right, left}};
}

TEST(Neighbours, LieBesideEachBorderThatIsSeen) {
  LaneLayout layout = lanes_side_by_side();
  find_neighbours(layout);
  const auto& neighbours = layout.lanes[0].left_neighbours;
  ASSERT_EQ(neighbours.size(), 2U);
  EXPECT_EQ(neighbours[0].lane, 2U);
  EXPECT_EQ(ends(neighbours[0].range), std::pair(0.0, 20.0));
  EXPECT_TRUE(neighbours[0].crossable.empty());
  EXPECT_EQ(neighbours[1].lane, 2U);
  EXPECT_EQ(ends(neighbours[1].range), std::pair(30.0, 50.0));
  ASSERT_EQ(neighbours[1].crossable.size(), 1U);
  EXPECT_EQ(ends(neighbours[1].crossable[0]), std::pair(35.0, 50.0));
  EXPECT_EQ(layout.lanes[1].right_neighbours.size(), 2U);
  EXPECT_TRUE(layout.lanes[0].right_neighbours.empty());
  EXPECT_TRUE(layout.lanes[1].left_neighbours.empty());
}

}  // namespace
}  // namespace laneloom::lanes
