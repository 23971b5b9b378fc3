#include "mapping/lanes/gores.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace laneloom::lanes {
namespace {

/// Places 1 m apart along 40 m, between borders that are `begin_m` apart at first and `end_m` at last.
std::vector<PlaceBetween> places(double begin_m, double end_m) {
  std::vector<PlaceBetween> places;
  for (int i = 0; i <= 40; ++i)
    places.push_back({.along_m = 1.0 * i, .width_m = begin_m + (end_m - begin_m) * i / 40.0});
  return places;
}

std::ptrdiff_t gore_m(const std::vector<PlaceBetween>& places) {
  const GorePlaces gore = in_gore(places);
  std::ptrdiff_t count = 0;
  for (std::size_t i = 0; i < places.size(); ++i) count += gore.contains(i) ? 1 : 0;
  return count;
}

TEST(Gores, LieBetweenBordersThatMeet) {
  EXPECT_EQ(gore_m(places(0.2, 4.2)), 41);
  EXPECT_EQ(gore_m(places(4.2, 0.2)), 41);
}

TEST(Gores, LieWhereTheMeetingIsNotSeen) {
  EXPECT_EQ(gore_m(places(1.5, 4.2)), 41);
  EXPECT_EQ(gore_m(places(4.2, 1.5)), 41);
}

TEST(Gores, ALaneThatWidensALittleIsNone) { EXPECT_EQ(gore_m(places(3.0, 3.8)), 0); }

TEST(Gores, ALaneThatBeginsToWidenIsNone) {
  auto widening = places(3.0, 3.0);
  for (PlaceBetween& place : widening) place.width_m += std::max(0.0, place.along_m - 10.0) / 10.0;
  EXPECT_EQ(gore_m(widening), 0);
}

TEST(Gores, ALaneThatOpensBesideDashesIsNone) {
  auto turning_lane = places(0.2, 4.2);
  for (PlaceBetween& place : turning_lane) place.may_be_crossed = true;
  EXPECT_LT(gore_m(turning_lane), 15);
}

TEST(Gores, EndWhereALineMayBeCrossed) {
  auto gore = places(0.2, 4.2);
  for (PlaceBetween& place : gore) place.may_be_crossed = place.along_m > 29.5;
  EXPECT_EQ(gore_m(gore), 30);
}

TEST(Gores, AreNotEnteredAcrossDashesThatEndWhereTheyBegin) {
  auto gore = places(0.2, 4.2);
  for (PlaceBetween& place : gore) place.may_be_crossed = place.along_m < 5.0;
  EXPECT_EQ(gore_m(gore), 41);
}

}  // namespace
}  // namespace laneloom::lanes
