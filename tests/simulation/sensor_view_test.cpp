#include "simulation/sensor_view.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "simulation/occlusion.hpp"

namespace laneloom::simulation {
namespace {

const Eigen::Isometry3d kOrigin = Eigen::Isometry3d::Identity();

TEST(SensorView, ClipsALineToItsBox) {
  const auto pieces = visible_pieces(ViewedLine({{-100.0, 1.0, 0.0}, {100.0, 1.0, 0.0}}), {}, kOrigin);
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_EQ(pieces[0].points, (Polyline{{-40.0, 1.0, 0.0}, {50.0, 1.0, 0.0}}));
  EXPECT_DOUBLE_EQ(pieces[0].arc.from_m, 60.0);
  EXPECT_DOUBLE_EQ(pieces[0].arc.to_m, 150.0);
}

TEST(SensorView, ALineThatLeavesAndComesBackIsTwoPieces) {
  const Polyline line{{0.0, 15.0, 0.0}, {10.0, 25.0, 0.0}, {20.0, 15.0, 0.0}, {20.0, 20.9, 0.0}};
  const auto pieces = visible_pieces(ViewedLine(line), {}, kOrigin);
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_NEAR((pieces[0].points.back() - Point(5.0, 20.0, 0.0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((pieces[1].points.front() - Point(15.0, 20.0, 0.0)).norm(), 0.0, 1e-9);
  EXPECT_EQ(pieces[1].points.size(), 3u);
}

TEST(SensorView, ARoadOnABridgeAboveIsNotSeen) {
  EXPECT_TRUE(visible_pieces(ViewedLine({{10.0, -9.0, 6.0}, {10.0, 9.0, 6.0}}), {}, kOrigin).empty());
  EXPECT_EQ(visible_pieces(ViewedLine({{10.0, -9.0, 2.0}, {10.0, 9.0, 2.0}}), {}, kOrigin).size(), 1u);
}

TEST(SensorView, SnippetsBelowAMetreAreNotDetected) {
  EXPECT_TRUE(visible_pieces(ViewedLine({{49.5, 0.0, 0.0}, {90.0, 0.0, 0.0}}), {}, kOrigin).empty());
}

TEST(SensorView, ARingOverItsSeamIsOnePiece) {
  Polyline ring;
  for (int i = 0; i <= 72; ++i) {
    const double angle = i * std::numbers::pi / 36.0;
    ring.emplace_back(60.0 * std::cos(angle) - 60.0, 60.0 * std::sin(angle), 0.0);
  }
  ring.back() = ring.front();
  const auto pieces = visible_pieces(ViewedLine(ring), {}, kOrigin);
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_LT(pieces[0].arc.from_m, 0.0);
  EXPECT_GT(pieces[0].arc.to_m, 0.0);
  EXPECT_NEAR(pieces[0].points.front().y(), -20.0, 1e-9);
  EXPECT_NEAR(pieces[0].points.back().y(), 20.0, 1e-9);
}

TEST(Occluders, HideWhatIsBehindThem) {
  NoiseProfile noise;
  noise.occluder_rate_hz = 10.0;  // one comes at once
  noise.occluder_dwell_s = 1e9;
  Random random(5);
  Occluders occluders;
  occluders.step(0.1, noise, random);
  ASSERT_EQ(occluders.areas().size(), 1u);
  const Polyline& area = occluders.areas()[0];
  Point inside = Point::Zero();
  for (const Point& corner : area) inside += corner / static_cast<double>(area.size());
  const Point across(-inside.y(), inside.x(), 0.0);
  const Polyline behind{inside - 3.0 * across, inside + 3.0 * across};
  EXPECT_EQ(occluders.visible_parts({{0.0, length(behind)}, behind}).size(), 2u);
  const Polyline before{{2.0, -3.0, 0.0}, {2.0, 3.0, 0.0}};
  EXPECT_EQ(occluders.visible_parts({{0.0, 6.0}, before}).size(), 1u);
}

}  // namespace
}  // namespace laneloom::simulation
