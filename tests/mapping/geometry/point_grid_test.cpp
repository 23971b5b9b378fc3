#include "mapping/geometry/point_grid.hpp"

#include <gmock/gmock.h>

namespace laneloom::geometry {
namespace {

struct Thing {
  Point position;
  int number = 0;
};

std::vector<int> around(const PointGrid<Thing>& grid, const Point& place, double reach_m) {
  std::vector<int> found;
  grid.around(place, reach_m, [&](const Thing& thing) {
    if ((thing.position - place).norm() <= reach_m) found.push_back(thing.number);
  });
  return found;
}

TEST(PointGrid, FindsWhatIsWithinReach) {
  const PointGrid<Thing> grid({{{0, 0, 0}, 1}, {{2.5, 0, 0}, 2}, {{0, -7, 0}, 3}}, 1.0);
  EXPECT_THAT(around(grid, {0.5, 0, 0}, 2.0), testing::UnorderedElementsAre(1, 2));
  EXPECT_THAT(around(grid, {0, -9, 0}, 2.0), testing::ElementsAre(3));
  EXPECT_THAT(around(grid, {500, 500, 0}, 2.0), testing::IsEmpty());
  EXPECT_THAT(around(PointGrid<Thing>(), {0, 0, 0}, 2.0), testing::IsEmpty());
}

TEST(PointGrid, FindsThingsThatAreScatteredOverAContinent) {
  const PointGrid<Thing> grid({{{0, 0, 0}, 1}, {{4.0e6, 3.0e6, 0}, 2}, {{4.0e6, 3.0e6 + 1, 0}, 3}}, 1.0);
  EXPECT_THAT(around(grid, {0.5, 0, 0}, 2.0), testing::ElementsAre(1));
  EXPECT_THAT(around(grid, {4.0e6, 3.0e6, 0}, 2.0), testing::UnorderedElementsAre(2, 3));
}

}  // namespace
}  // namespace laneloom::geometry
