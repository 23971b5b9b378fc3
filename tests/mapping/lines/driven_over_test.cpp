#include "mapping/lines/driven_over.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "mapping/shapes.hpp"

namespace laneloom::lines {
namespace {

using test::straight;

/// A vehicle drove along x, from 0 to 20 m.
const Polyline kWay = straight({0, 0, 0}, {20, 0, 0}, 11);

/// The number of stations of a line that lose their evidence.
std::size_t denied(const Polyline& points, MarkingType type = MarkingType::roadedge,
                   const Polyline& way = kWay) {
  std::vector<Line> lines{test::line(1, points, type)};
  deny_driven_over(way, lines);
  return static_cast<std::size_t>(std::ranges::count_if(
      lines.front().stations, [](const Station& station) { return station.log_odds < -10.0; }));
}

TEST(DrivenOver, NoEdgeIsWhereTheVehicleDrove) {
  EXPECT_EQ(denied(straight({-10.5, 0.5, 0}, {40.5, 0.5, 0}, 52)), 20U) << "beside the way";
  EXPECT_EQ(denied(straight({40.5, -0.7, 0}, {-10.5, -0.7, 0}, 52)), 20U) << "likewise, the other way round";
  EXPECT_EQ(denied(straight({0.5, 0.9, 0}, {19.5, 0.9, 0}, 20)), 0U) << "beside the body";
}

TEST(DrivenOver, LinesMayBeDrivenOver) {
  for (const MarkingType type : {MarkingType::laneline, MarkingType::stopline})
    EXPECT_EQ(denied(straight({0.5, 0.2, 0}, {19.5, 0.2, 0}, 20), type), 0U);
}

TEST(DrivenOver, ALoweredKerbIsCrossed) {
  EXPECT_EQ(denied(straight({5, -5, 0}, {15, 5, 0}, 15)), 0U);
  EXPECT_EQ(denied(straight({10, -5, 0}, {10, 5, 0}, 11)), 0U);
}

TEST(DrivenOver, AnEdgeOnAnotherLevelStays) {
  EXPECT_EQ(denied(straight({0.5, 0.2, 6}, {19.5, 0.2, 6}, 20)), 0U) << "on a bridge above";
  EXPECT_EQ(denied(straight({0.5, 0.2, -6}, {19.5, 0.2, -6}, 20)), 0U) << "below a bridge";
  EXPECT_EQ(denied(straight({0.5, 0.2, -1.5}, {19.5, 0.2, -1.5}, 20)), 20U)
      << "the vehicle's origin is its roof";
}

TEST(DrivenOver, AVehicleThatHasNotMovedDeniesNothing) {
  EXPECT_EQ(denied(straight({-1, 0, 0}, {1, 0, 0}, 3), MarkingType::roadedge, {{0, 0, 0}}), 0U);
  EXPECT_EQ(denied(straight({-1, 0, 0}, {1, 0, 0}, 3), MarkingType::roadedge, {}), 0U);
}

}  // namespace
}  // namespace laneloom::lines
