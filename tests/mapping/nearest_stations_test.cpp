#include "mapping/nearest_stations.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "mapping/shapes.hpp"

namespace laneloom {
namespace {

constexpr double kGate_m = 0.6;

/// Which lines a point lies on, and at which station.
using Places = std::map<std::uint32_t, std::uint32_t>;

bool lies_on(const Line& line, std::size_t nearest, const Point& point) {
  const StationFoot foot = foot_at(line, nearest, point);
  const double last = static_cast<double>(line.stations.size() - 1);
  return foot.index >= -0.5 && foot.index <= last + 0.5 && std::abs(foot.lateral_m) <= kGate_m;
}

Places found(NearestStations& nearest_stations, const std::vector<Line>& lines, const Point& point) {
  Places places;
  for (const NearestStation& nearest : nearest_stations.around(point)) {
    if (!lies_on(lines[nearest.line], nearest.station, point)) continue;
    EXPECT_TRUE(places.emplace(nearest.line, nearest.station).second);
  }
  return places;
}

/// From all stations of the cells around the point, whatever their line's reach.
Places expected(const StationGrid& grid, const std::vector<Line>& lines, const Point& point) {
  std::map<std::uint32_t, std::pair<double, std::uint32_t>> nearest;
  grid.around(point, [&](const StationGrid::Entry& entry) {
    const Point offset = entry.position - point;
    if (std::abs(offset.z()) > 2.0) return;
    const double distance_m = offset.head<2>().norm();
    const auto [known, is_new] = nearest.try_emplace(entry.line, distance_m, entry.station);
    if (!is_new && distance_m < known->second.first) known->second = {distance_m, entry.station};
  });
  Places places;
  for (const auto& [line, station] : nearest)
    if (lies_on(lines[line], station.second, point)) places.emplace(line, station.second);
  return places;
}

/// Stations about `step_m` apart, whose heading and height wander.
Line wandering_line(ElementId id, double step_m, double turn_rad, double climb_m, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  double heading_rad = 3.0 * normal(random);
  Polyline points{10.0 * Point(normal(random), normal(random), 0.1 * normal(random))};
  while (points.size() < 40) {
    heading_rad += turn_rad * normal(random);
    points.push_back(points.back() + Point(step_m * std::cos(heading_rad), step_m * std::sin(heading_rad),
                                           climb_m * normal(random)));
  }
  return test::line(id, points);
}

TEST(NearestStations, MissNoLineThatAPointLiesOn) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::size_t places = 0;
  for (const double step_m : {0.7, 1.0, 1.4, 3.9}) {       // so far apart that none may be within a cell
    for (const double turn_rad : {0.02, 0.3, 1.2, 3.0}) {  // to sharp corners
      for (const double climb_m : {0.02, 0.7}) {           // to another level and back
        std::vector<Line> lines;
        for (ElementId id = 1; id <= 8; ++id)
          lines.push_back(wandering_line(id, step_m, turn_rad, climb_m, random));
        const StationGrid grid(lines, false);
        NearestStations nearest_stations(lines, false, kGate_m);
        for (const Line& line : lines) {
          for (std::size_t k = 1; k < line.stations.size(); ++k) {
            const Point &a = line.stations[k - 1].position, &b = line.stations[k].position;
            const Point point = a + share(random) * (b - a) + Point(normal(random), normal(random), 0.0);
            const Places all = expected(grid, lines, point);
            EXPECT_EQ(found(nearest_stations, lines, point), all);
            places += all.size();
          }
        }
      }
    }
  }
  EXPECT_GT(places, 1000U);
}

TEST(NearestStations, FindALineWhoseNearestStationIsOutOfSight) {
  // The cells begin at -4.4 m: the station at 3.65 m is two cells away from the point, the other one is not.
  const std::vector<Line> lines{test::line(1, test::straight({-0.85, 0, 0}, {3.65, 0, 0})),
                                test::line(2, test::straight({-4.4, 3, 0}, {-4.0, 3, 0}))};
  NearestStations nearest_stations(lines, false, kGate_m);
  ASSERT_EQ(nearest_stations.around({1.55, 0.1, 0}).size(), 1U);
  EXPECT_EQ(nearest_stations.around({1.55, 0.1, 0}).front().station, 0U);
}

TEST(NearestStations, AreOfStoplinesOrOfAllOthers) {
  const std::vector<Line> lines{
      test::line(1, test::straight({0, 0, 0}, {10, 0, 0}, 11)),
      test::line(2, test::straight({0, 0, 0}, {10, 0, 0}, 11), MarkingType::stopline)};
  NearestStations along(lines, false, kGate_m), across(lines, true, kGate_m);
  ASSERT_EQ(along.around({5, 0, 0}).size(), 1U);
  EXPECT_EQ(along.around({5, 0, 0}).front().line, 0U);
  ASSERT_EQ(across.around({5, 0, 0}).size(), 1U);
  EXPECT_EQ(across.around({5, 0, 0}).front().line, 1U);
}

TEST(NearestStations, LeaveOutWhatIsTooFarToLieOn) {
  const std::vector<Line> lines{test::line(1, test::straight({0, 0, 0}, {10, 0, 0}, 11))};
  NearestStations nearest_stations(lines, false, kGate_m);
  EXPECT_EQ(nearest_stations.around({5.4, 0.5, 0}).size(), 1U);
  EXPECT_TRUE(nearest_stations.around({5.4, 1.5, 0}).empty());
  EXPECT_TRUE(nearest_stations.around({5.4, 0.5, 3}).empty());  // on another level
}

}  // namespace
}  // namespace laneloom
