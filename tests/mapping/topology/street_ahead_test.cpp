#include "mapping/topology/street_ahead.hpp"

#include <gmock/gmock.h>

#include "mapping/lanes/ways.hpp"

namespace laneloom::topology {
namespace {

using test::arc;
using test::straight;

constexpr double kRadius_m = 40.0;

/// A street to the east that bends to the north behind x = 0, drawn `aside_m` beside its place, and a node
/// every 8 m.
SdMap bending_street(double aside_m) {
  SdWay way{.id = 1};
  Polyline line = straight({-100, 0, 0}, {-10, 0, 0}, 10);
  const Polyline bend = arc({0, kRadius_m, 0}, kRadius_m, -90.0, 0.0);
  for (std::size_t i = 0; i < bend.size(); i += 32) line.push_back(bend[i]);
  for (const Point& point : line) {
    way.nodes.push_back(static_cast<std::int64_t>(way.nodes.size()) + 1);
    way.points.emplace_back(point.x() + aside_m, point.y() - aside_m);
  }
  return SdMap({way}, {});
}

/// A way to the east that ends at `end`, 20 m long, in a lane.
Way way_to(const Point& end) {
  Way way;
  for (double s_m = -20.0; s_m <= 0.0; s_m += 1.0)
    way.stations.push_back({.point = end + Point(s_m, 0, 0), .lane = 1, .lateral_stddev_m = 0.2});
  return way;
}

/// Places of the vehicle that came along the road's middle.
Polyline driven_to(double x_m) { return straight({x_m - 40.0, 0, 0}, {x_m, 0, 0}, 21); }

double off_the_road_m(const WayStation& station) {
  const Point& point = station.point;
  return point.x() < 0.0 ? std::abs(point.y())
                         : std::abs((point - Point(0, kRadius_m, 0)).norm() - kRadius_m);
}

TEST(StreetAhead, AWayGoesOnAsTheStreetBendsWhereverTheMapHasIt) {
  for (const double aside_m : {0.0, 2.0, -2.0}) {
    Way way = way_to({0, 0, 0});
    ASSERT_TRUE(go_on_along_street(bending_street(aside_m), driven_to(-20.0), way));
    EXPECT_GT(way.length(), 20.0 + 15.0);
    EXPECT_NEAR(way.length(), 20.0 + 30.0, 15.0) << "at most 30 m";
    for (const WayStation& station : way.stations) EXPECT_LT(off_the_road_m(station), 1.5) << aside_m;
  }
}

TEST(StreetAhead, ItsDeviationGrowsUpToHalfALane) {
  Way way = way_to({0, 0, 0});
  ASSERT_TRUE(go_on_along_street(bending_street(2.0), driven_to(-20.0), way));
  for (std::size_t i = 21; i < way.stations.size(); ++i) {
    EXPECT_EQ(way.stations[i].status, ElementStatus::inferred);
    EXPECT_EQ(way.stations[i].lane, kNoElement);
    EXPECT_GT(way.stations[i].lateral_stddev_m, way.stations[i - 1].lateral_stddev_m);
  }
  EXPECT_LE(way.stations.back().lateral_stddev_m, 1.75);
  Way doubtful = way_to({0, 0, 0});
  doubtful.stations.back().lateral_stddev_m = 1.0;
  ASSERT_TRUE(go_on_along_street(bending_street(2.0), driven_to(-20.0), doubtful));
  EXPECT_LT(doubtful.length(), way.length());
}

TEST(StreetAhead, ItsDeviationGrowsFasterIntoABend) {
  const SdMap straight_street({{.id = 1, .nodes = {1, 2}, .points = {{-100, 2}, {100, 2}}}}, {});
  const auto deviation_20_m_on = [](const SdMap& map) {
    Way way = way_to({0, 0, 0});
    return go_on_along_street(map, driven_to(-20.0), way) ? way.stations.at(40).lateral_stddev_m : -1.0;
  };
  EXPECT_GT(deviation_20_m_on(straight_street), 0.2) << "a node may lie beside the street";
  EXPECT_GT(deviation_20_m_on(bending_street(2.0)), 1.3 * deviation_20_m_on(straight_street));
}

TEST(StreetAhead, NoStreetThatDoesNotFitLeadsOn) {
  Way way = way_to({0, 0, 0});
  EXPECT_FALSE(go_on_along_street(SdMap(), driven_to(-20.0), way));
  EXPECT_FALSE(go_on_along_street(bending_street(30.0), driven_to(-20.0), way)) << "too far away";
  const SdMap dead_end({{.id = 1, .nodes = {1, 2}, .points = {{-100, 0}, {-21, 0}}}}, {});
  EXPECT_FALSE(go_on_along_street(dead_end, driven_to(-20.0), way));
  Polyline slalom = driven_to(-20.0);
  for (std::size_t i = 0; i < slalom.size(); ++i) slalom[i].y() += i % 8 < 4 ? 3.0 : -3.0;
  Way other = way_to({0, 0, 0});
  other.stations.erase(other.stations.begin(), other.stations.end() - 2);
  EXPECT_FALSE(go_on_along_street(bending_street(0.0), slalom, other)) << "driven elsewhere than on it";
  EXPECT_EQ(other.stations.size(), 2U);
}

}  // namespace
}  // namespace laneloom::topology
