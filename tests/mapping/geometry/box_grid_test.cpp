#include "mapping/geometry/box_grid.hpp"

#include <gmock/gmock.h>

namespace laneloom::geometry {
namespace {

using Grid = BoxGrid<int>;

Grid::Boxed boxed(int number, const Eigen::Vector2d& min, const Eigen::Vector2d& max) {
  return {{min, max}, number};
}

std::vector<int> at(const Grid& grid, const Point& place) {
  std::vector<int> found;
  grid.at(place, [&](int number) { found.push_back(number); });
  return found;
}

TEST(BoxGrid, FindsWhatReachesAPlaceInTheOrderOfTheThings) {
  const Grid grid({boxed(1, {-7.2, 0.1}, {3.5, 0.9}), boxed(2, {3.0, -4.0}, {3.0, 8.0})}, 1.0);
  EXPECT_THAT(at(grid, {-7.2, 0.1, 0}), testing::ElementsAre(1)) << "a corner";
  EXPECT_THAT(at(grid, {-2.0, 0.5, 0}), testing::ElementsAre(1));
  EXPECT_THAT(at(grid, {3.0, 0.5, 9}), testing::ElementsAre(1, 2)) << "whatever the height";
  EXPECT_THAT(at(grid, {3.0, 8.0, 0}), testing::ElementsAre(2)) << "the other end";
  EXPECT_THAT(at(grid, {-2.0, 5.0, 0}), testing::IsEmpty());
}

TEST(BoxGrid, NothingReachesBeyondTheGrid) {
  const Grid grid({boxed(1, {0, 0}, {2, 2})}, 1.0);
  for (const double far : {-1e12, -1.5, 3.5, 1e12}) {
    EXPECT_THAT(at(grid, {far, 1, 0}), testing::IsEmpty());
    EXPECT_THAT(at(grid, {1, far, 0}), testing::IsEmpty());
  }
  EXPECT_THAT(at(Grid({}, 1.0), {0, 0, 0}), testing::IsEmpty());
}

}  // namespace
}  // namespace laneloom::geometry
