#include "mapping/geometry/map_box.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "mapping/shapes.hpp"

namespace laneloom::geometry {
namespace {

TEST(MapBox, TurnsWithTheVehicle) {
  const MapBox range({}, test::at(100, 50, std::numbers::pi / 2));
  EXPECT_TRUE(range.keeps({100, 104, 0}));  // 54 m ahead: within the margin
  EXPECT_FALSE(range.keeps({100, 106, 0}));
  EXPECT_TRUE(range.keeps({119, 50, 0}));  // 19 m to the right: within the margin
  EXPECT_FALSE(range.keeps({121, 50, 0}));
  EXPECT_TRUE(range.keeps({100, 50, 500}));  // any height
}

TEST(MapBox, CutsALineAtTheBox) {
  const MapBox range({}, test::at(0));
  const auto stretches = range.inside({{-25, 0, 0}, {55, 0, 0}});
  ASSERT_EQ(stretches.size(), 1U);
  EXPECT_DOUBLE_EQ(stretches[0].from_m, 20.0);
  EXPECT_DOUBLE_EQ(stretches[0].to_m, 55.0);
}

TEST(MapBox, ALineInsideIsOneStretchWhateverItsVertices) {
  const MapBox range({}, test::at(0));
  const auto line = test::straight({-4, 0, 0}, {20, 0, 0}, 13);
  const auto stretches = range.inside(line);
  ASSERT_EQ(stretches.size(), 1U);
  EXPECT_DOUBLE_EQ(stretches[0].length(), 24.0);
}

TEST(MapBox, ALineThatComesBackHasTwoStretches) {
  const MapBox range({}, test::at(0));
  const auto stretches = range.inside({{0, 0, 0}, {0, 20, 0}, {10, 20, 0}, {10, 0, 0}});
  ASSERT_EQ(stretches.size(), 2U);
  EXPECT_DOUBLE_EQ(stretches[0].to_m, 15.0);
  EXPECT_DOUBLE_EQ(stretches[1].from_m, 35.0);
}

TEST(MapBox, ALineOutsideHasNone) {
  EXPECT_TRUE(MapBox({}, test::at(0)).inside({{0, 16, 0}, {30, 16, 0}}).empty());
}

}  // namespace
}  // namespace laneloom::geometry
