#include "mapping/lanes/wished_turn.hpp"

#include <gtest/gtest.h>

#include "mapping/shapes.hpp"

namespace laneloom::lanes {
namespace {

using Turn = Linkage::Turn;

WishedTurn left_in(double distance_m) {
  return {{.turn = Turn::left, .distance_m = distance_m}, Point(100, 0, 0)};
}

/// A way through a lane that it enters by a turn, and one that begins in a lane.
Way way_into(ElementId lane, Turn turn) { return {.lanes = {{.id = lane, .entry = turn}}}; }
Way way_from(ElementId lane) { return {.stations = {{.lane = lane}}}; }

TEST(WishedTurn, ComesNearerAsTheVehicleDrives) {
  WishedTurn turn = left_in(80.0);
  EXPECT_EQ(turn.wish(), WayWish::left);
  const double from_m = turn.range().from_m;
  turn.drive_to(test::at(130));
  EXPECT_NEAR(turn.range().from_m, from_m - 30.0, 1e-9);
  turn.drive_to(test::at(129.5, 0.1));
  EXPECT_NEAR(turn.range().from_m, from_m - 29.5, 1e-9) << "while it stands, its pose goes to and fro";
  turn.forget_place();
  turn.drive_to(test::at(1130));
  EXPECT_NEAR(turn.range().from_m, from_m - 29.5, 1e-9) << "the map frame has jumped, the vehicle has not";
  turn.drive_to(test::at(1140));
  EXPECT_NEAR(turn.range().from_m, from_m - 39.5, 1e-9);
}

TEST(WishedTurn, IsOverInTheLaneThatItLeadsInto) {
  const WishedTurn turn = left_in(10.0);
  const Way into = way_into(7, Turn::left), now = way_from(7);
  EXPECT_TRUE(turn.is_over(&into, &now));
  const Way before = way_from(6), straight = way_into(7, Turn::straight);
  EXPECT_FALSE(turn.is_over(&into, &before)) << "on the way there";
  EXPECT_FALSE(turn.is_over(&straight, &now)) << "it went straight on";
  EXPECT_FALSE(turn.is_over(nullptr, &now));
  EXPECT_FALSE(turn.is_over(&into, nullptr)) << "across the intersection";
  EXPECT_FALSE(left_in(150.0).is_over(&into, &now)) << "that was the turn before it, or a bend of the road";
}

TEST(WishedTurn, IsOverBehindThePlace) {
  WishedTurn turn = left_in(10.0);
  turn.drive_to(test::at(120));
  EXPECT_FALSE(turn.is_over(nullptr, nullptr)) << "a navigation may be wrong by some metres";
  turn.drive_to(test::at(126));
  EXPECT_TRUE(turn.is_over(nullptr, nullptr));
  EXPECT_FALSE(WishedTurn().is_over(nullptr, nullptr)) << "nothing was wished";
}

TEST(WishedTurn, IsOnlyOneToTheLeftOrRight) {
  for (const Turn turn : {Turn::unknown, Turn::straight, Turn::u_turn})
    EXPECT_EQ(WishedTurn({.turn = turn, .distance_m = 20.0}, Point::Zero()).wish(), WayWish::straight);
  EXPECT_EQ(WishedTurn({.turn = Turn::right}, Point::Zero()).wish(), WayWish::right);
}

}  // namespace
}  // namespace laneloom::lanes
