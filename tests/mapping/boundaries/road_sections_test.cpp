#include "mapping/boundaries/road_sections.hpp"

#include <gmock/gmock.h>

#include "mapping/shapes.hpp"

namespace laneloom::boundaries {
namespace {

using test::boundary;
using test::straight;
using ::testing::ElementsAre;

SectionGraph sections_of(const std::vector<LaneBoundary>& boundaries,
                         const Eigen::Isometry3d& T_map_body = test::at(0)) {
  return road_sections(boundaries, T_map_body, {});
}

// Paper, Fig. 5 (a): an intersection parts the boundaries into road sections.
TEST(RoadSections, AnIntersectionPartsThem) {
  std::vector<LaneBoundary> boundaries{
      boundary(1, straight({-20, 0, 0}, {0, 0, 0})), boundary(2, straight({-20, 3.5, 0}, {0, 3.5, 0})),
      boundary(3, straight({20, 0, 0}, {40, 0, 0})), boundary(4, straight({20, 3.5, 0}, {40, 3.5, 0})),
      boundary(5, straight({8, 10, 0}, {8, 30, 0})), boundary(6, straight({11.5, 10, 0}, {11.5, 30, 0}))};
  const auto graph = sections_of(boundaries);
  ASSERT_EQ(graph.sections.size(), 3U);
  EXPECT_THAT(graph.sections[0].boundaries, ElementsAre(0, 1));
  EXPECT_THAT(graph.sections[1].boundaries, ElementsAre(2, 3));
  EXPECT_THAT(graph.sections[2].boundaries, ElementsAre(4, 5));
}

TEST(RoadSections, ALongBoundaryJoinsThoseThatDoNotOverlapEachOther) {
  std::vector<LaneBoundary> boundaries{boundary(1, straight({0, 0, 0}, {40, 0, 0})),
                                       boundary(2, straight({0, 3.5, 0}, {10, 3.5, 0})),
                                       boundary(3, straight({25, 3.5, 0}, {40, 3.5, 0}))};
  EXPECT_EQ(sections_of(boundaries).sections.size(), 1U);
}

TEST(RoadSections, AllRunWithTheVehicle) {
  std::vector<LaneBoundary> boundaries{boundary(1, straight({30, 0, 0}, {0, 0, 0})),
                                       boundary(2, straight({0, 3.5, 0}, {30, 3.5, 0}))};
  const Boundaries turned = sections_of(boundaries, test::at(5)).boundaries;
  for (const LaneBoundary& line : turned)
    EXPECT_LT(line.marking.points.front().x(), line.marking.points.back().x());
}

TEST(RoadSections, AnEdgeThatTurnsOffDoesNotTurnTheRest) {
  // Beyond an intersection: two lines that lead on, and the edge, which comes round the corner from the
  // right.
  Polyline edge = straight({46, -4, 0}, {26, -4, 0});
  for (const Point& point : straight({24, -6, 0}, {24, -21, 0})) edge.push_back(point);
  std::vector<LaneBoundary> boundaries{boundary(1, edge), boundary(2, straight({45, 0, 0}, {25, 0, 0})),
                                       boundary(3, straight({45, 3.5, 0}, {25, 3.5, 0}))};
  const Boundaries turned = sections_of(boundaries).boundaries;
  for (const LaneBoundary& line : turned)
    EXPECT_LT(line.marking.points.front().x(), line.marking.points.back().x());
}

TEST(RoadSections, TheRightOnesComeByTheirDistance) {
  std::vector<LaneBoundary> boundaries{
      boundary(1, straight({30, -7, 0}, {0, -7, 0})), boundary(2, straight({0, 0, 0}, {30, 0, 0})),
      boundary(3, straight({0, -3.5, 0}, {30, -3.5, 0})), boundary(4, straight({0, 3.5, 0}, {30, 3.5, 0}))};
  const auto graph = sections_of(boundaries);
  const auto right_of = [&](std::size_t i) {
    std::vector<std::size_t> order;
    for (const SideBySide& beside : graph.beside[i])
      if (beside.side() == Side::right) order.push_back(beside.other);
    return order;
  };
  EXPECT_THAT(right_of(3), ElementsAre(1, 2, 0));
  EXPECT_THAT(right_of(1), ElementsAre(2, 0));
  EXPECT_THAT(right_of(0), ElementsAre());
  EXPECT_NEAR(graph.beside[1][2].lateral_m, -7.0, 1e-9);
}

TEST(RoadSections, SideBySideIsWhatTheyHaveInCommon) {
  std::vector<LaneBoundary> boundaries{
      boundary(1, straight({0, 0, 0}, {30, 0, 0})), boundary(2, straight({10, 3.5, 0}, {11.5, 3.5, 0})),
      boundary(3, straight({20, 3.5, 0}, {40, 3.5, 0})), boundary(4, straight({0, 3.5, 6}, {30, 3.5, 6}))};
  const auto graph = sections_of(boundaries);
  ASSERT_EQ(graph.beside[0].size(), 2U) << "nor what lies on a bridge";
  EXPECT_NEAR(graph.beside[1][0].length_m, 1.5, 1e-9);
  EXPECT_NEAR(graph.beside[2][0].length_m, 10.0, 1.0);
}

TEST(RoadSections, OfTwoThatLieSideBySideOneIsOnTheRight) {
  // Staggered, bent towards each other, and run through in either direction.
  for (const bool turned : {false, true}) {
    std::vector<LaneBoundary> boundaries{boundary(1, {{0, 0, 0}, {20, 1, 0}, {40, 0, 0}}),
                                         boundary(2, {{30, 4, 0}, {45, 3.5, 0}, {60, 4, 0}})};
    if (turned) std::ranges::reverse(boundaries[1].marking.points);
    const auto graph = sections_of(boundaries);
    ASSERT_EQ(graph.beside[1].size(), 1U);
    EXPECT_EQ(graph.beside[1][0].side(), Side::right);
    ASSERT_EQ(graph.beside[0].size(), 1U);
    EXPECT_EQ(graph.beside[0][0].side(), Side::left);
  }
}

TEST(RoadSections, ARoadThatCrossesTheVehiclesKeepsItsOwnDirection) {
  std::vector<LaneBoundary> boundaries{boundary(1, straight({20, 15, 0}, {20, -15, 0})),
                                       boundary(2, straight({23.5, -15, 0}, {23.5, 10, 0}))};
  const Boundaries turned = sections_of(boundaries).boundaries;
  for (const LaneBoundary& line : turned)
    EXPECT_GT(line.marking.points.front().y(), line.marking.points.back().y());
}

}  // namespace
}  // namespace laneloom::boundaries
