#include "mapping/lines/nearest_stations.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <optional>
#include <random>

#include "mapping/shapes.hpp"

namespace laneloom::lines {
namespace {

constexpr double kGate_m = 0.6;

/// The lines that a point lies on, each with the nearest station.
using Places = std::map<std::uint32_t, std::uint32_t>;

bool lies_on(const Line& line, std::size_t nearest, const Point& point) {
  const StationFoot foot = foot_at(line, nearest, point);
  const double last = static_cast<double>(line.stations.size() - 1);
  return foot.index >= -0.5 && foot.index <= last + 0.5 && std::abs(foot.lateral_m) <= kGate_m;
}

Places found(NearestStations& nearest_stations, const std::vector<Line>& lines, const Point& point) {
  Places places;
  for (const NearestStation& nearest : nearest_stations.around(point, false)) {
    if (!lies_on(lines[nearest.line], nearest.station, point)) continue;
    EXPECT_TRUE(places.emplace(nearest.line, nearest.station).second);
  }
  return places;
}

/// From all stations of the point's level that are within reach.
Places expected(const std::vector<Line>& lines, const Point& point, double reach_m) {
  Places places;
  for (std::uint32_t i = 0; i < lines.size(); ++i) {
    double nearest_m = reach_m;
    std::optional<std::uint32_t> nearest;
    for (std::uint32_t k = 0; k < lines[i].stations.size(); ++k) {
      const Point offset = lines[i].stations[k].position - point;
      const double distance_m = offset.head<2>().norm();
      if (std::abs(offset.z()) > 2.0 || distance_m >= nearest_m) continue;
      nearest_m = distance_m;
      nearest = k;
    }
    if (nearest && lies_on(lines[i], *nearest, point)) places.emplace(i, *nearest);
  }
  return places;
}

/// On one of two levels; stations about `step_m` apart, whose heading and height wander.
Line wandering_line(ElementId id, double step_m, double turn_rad, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  double heading_rad = 3.0 * normal(random);
  Polyline points{Point(10.0 * normal(random), 10.0 * normal(random), id % 2 == 0 ? 5.0 : 0.0)};
  while (points.size() < 40) {
    heading_rad += turn_rad * normal(random);
    points.push_back(points.back() + Point(step_m * std::cos(heading_rad), step_m * std::sin(heading_rad),
                                           0.02 * normal(random)));
  }
  return test::line(id, points);
}

TEST(NearestStations, MissNoLineThatAPointLiesOn) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::size_t places = 0;
  for (const double step_m : {0.7, 1.0, 1.4, 3.9, 9.0}) {
    const double reach_m = std::max(2.0, std::hypot(kGate_m, 0.5 * step_m));
    for (const double turn_rad : {0.02, 0.3, 1.2, 3.0}) {  // to sharp corners
      std::vector<Line> lines;
      for (ElementId id = 1; id <= 12; ++id) lines.push_back(wandering_line(id, step_m, turn_rad, random));
      NearestStations nearest_stations(lines, kGate_m);
      for (const Line& line : lines) {
        for (std::size_t k = 1; k < line.stations.size(); ++k) {
          const Point &a = line.stations[k - 1].position, &b = line.stations[k].position;
          const Point point = a + share(random) * (b - a) + Point(normal(random), normal(random), 0.0);
          const Places all = expected(lines, point, reach_m);
          EXPECT_EQ(found(nearest_stations, lines, point), all);
          places += all.size();
        }
      }
    }
  }
  EXPECT_GT(places, 1000U);
}

TEST(NearestStations, FindALineWhoseStationsAreFarApart) {
  const std::vector<Line> lines{test::line(1, test::straight({0, 0, 0}, {9, 0, 0}))};
  NearestStations nearest_stations(lines, kGate_m);
  ASSERT_EQ(nearest_stations.around({4.4, 0.6, 0}, false).size(), 1U);
  EXPECT_EQ(nearest_stations.around({4.4, 0.6, 0}, false).front().station, 0U);
  EXPECT_EQ(nearest_stations.around({4.6, 0.6, 0}, false).front().station, 1U);
}

TEST(NearestStations, OfASharpBendAreFoundTwoMetresOutsideOfIt) {
  const std::vector<Line> lines{test::line(1, {{-1, 0, 0}, {0, 0, 0}, {-1, 0.1, 0}})};
  NearestStations nearest_stations(lines, kGate_m);
  EXPECT_EQ(nearest_stations.around({1.9, 0, 0}, false).size(), 1U);
  EXPECT_TRUE(nearest_stations.around({2.1, 0, 0}, false).empty());
}

TEST(NearestStations, AreOfStoplinesOrOfAllOthers) {
  const std::vector<Line> lines{
      test::line(1, test::straight({0, 0, 0}, {10, 0, 0}, 11)),
      test::line(2, test::straight({0, 0, 0}, {10, 0, 0}, 11), MarkingType::stopline)};
  NearestStations nearest_stations(lines, kGate_m);
  ASSERT_EQ(nearest_stations.around({5, 0, 0}, false).size(), 1U);
  EXPECT_EQ(nearest_stations.around({5, 0, 0}, false).front().line, 0U);
  ASSERT_EQ(nearest_stations.around({5, 0, 0}, true).size(), 1U);
  EXPECT_EQ(nearest_stations.around({5, 0, 0}, true).front().line, 1U);
}

TEST(NearestStations, LeaveOutWhatIsTooFarToLieOn) {
  const std::vector<Line> lines{test::line(1, test::straight({0, 0, 0}, {10, 0, 0}, 11))};
  NearestStations nearest_stations(lines, kGate_m);
  EXPECT_EQ(nearest_stations.around({5.4, 0.5, 0}, false).size(), 1U);
  EXPECT_TRUE(nearest_stations.around({5.4, 1.5, 0}, false).empty());
  EXPECT_TRUE(nearest_stations.around({5.4, 0.5, 3}, false).empty());  // on another level
}

}  // namespace
}  // namespace laneloom::lines
