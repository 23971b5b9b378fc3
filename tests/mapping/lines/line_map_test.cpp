#include "mapping/lines/line_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "mapping/shapes.hpp"

namespace laneloom::lines {
namespace {

TEST(StationFoot, IsBetweenStationsWithItsSide) {
  const Line line = test::line(1, test::straight({0, 0, 1}, {10, 0, 1}, 11));
  const StationFoot foot = foot_at(line, 2, {2.5, 0.4, 1.3});
  EXPECT_DOUBLE_EQ(foot.index, 2.5);
  EXPECT_DOUBLE_EQ(foot.lateral_m, 0.4);
  EXPECT_NEAR(foot.height_m, 0.3, 1e-12);
  EXPECT_TRUE(foot.inside);
  EXPECT_DOUBLE_EQ(foot_at(line, 5, {5.2, -0.3, 1}).lateral_m, -0.3);
}

TEST(StationFoot, BeyondAnEndTheIndexSaysHowFar) {
  const Line line = test::line(1, test::straight({0, 0, 0}, {10, 0, 0}, 11));
  const StationFoot before = foot_at(line, 0, {-0.5, 0.2, 0});
  EXPECT_FALSE(before.inside);
  EXPECT_DOUBLE_EQ(before.index, -0.5);
  const StationFoot after = foot_at(line, 10, {11, 0.2, 0});
  EXPECT_FALSE(after.inside);
  EXPECT_DOUBLE_EQ(after.index, 11.0);
  EXPECT_DOUBLE_EQ(after.lateral_m, 0.2);
}

TEST(StationGrid, FindsEveryStationWithinReach) {
  const std::vector<Line> lines{test::line(1, test::straight({-30, 5, 0}, {40, 8, 0}, 71)),
                                test::line(2, test::arc({0, 0, 0}, 12, 0, 270))};
  const StationGrid grid = station_grid(lines);
  for (const Point& point :
       {Point(0, 6, 0), Point(-12, 0, 0), Point(40, 8, 0), Point(1e9, -1e9, 0), Point(-30, 5, 9)}) {
    for (const double reach_m : {0.4, 0.9, 2.3, 1e10}) {
      std::set<std::pair<std::uint32_t, std::uint32_t>> found;
      grid.around(point, reach_m, [&](const StationPlace& entry) {
        EXPECT_TRUE(found.insert({entry.line, entry.station}).second);
        EXPECT_EQ(entry.position, lines[entry.line].stations[entry.station].position);
        EXPECT_LT((entry.position - point).head<2>().norm(), std::numbers::sqrt2 * (reach_m + 1.0));
      });
      for (std::uint32_t i = 0; i < lines.size(); ++i) {
        for (std::uint32_t k = 0; k < lines[i].stations.size(); ++k) {
          const double distance_m = (lines[i].stations[k].position - point).head<2>().norm();
          if (distance_m >= reach_m) continue;
          EXPECT_TRUE(found.contains({i, k})) << point.transpose();
        }
      }
    }
  }
}

TEST(StationGrid, HoldsAStationJustBeforeTheEndOfItsLastCell) {
  const double last_m = std::nextafter(8.0, 0.0);  // one more cell is 9 when rounded
  const std::vector<Line> lines{test::line(1, {{0, 0, 0}, {last_m, last_m, 0}})};
  const StationGrid grid = station_grid(lines);
  std::set<std::uint32_t> found;
  grid.around({last_m, last_m, 0}, 0.5, [&](const StationPlace& entry) { found.insert(entry.station); });
  EXPECT_EQ(found, std::set<std::uint32_t>{1});
}

TEST(StationGrid, OfNothingFindsNothing) {
  station_grid({}).around({0, 0, 0}, 5.0, [](const StationPlace&) { ADD_FAILURE(); });
}

}  // namespace
}  // namespace laneloom::lines
