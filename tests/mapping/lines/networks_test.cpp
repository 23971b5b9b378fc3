#include "mapping/lines/networks.hpp"

#include <gtest/gtest.h>

namespace laneloom {
namespace {

TEST(Standpoint, ViewsFromOnePlaceAreTogetherLessThanTwo) {
  Standpoint standpoint;
  double sum = 0.0;
  for (int i = 0; i < 1000; ++i) sum += standpoint.news({5, 5, 0});
  EXPECT_LT(sum, 2.0);
}

TEST(Standpoint, EveryNewPlaceIsAnIndependentView) {
  Standpoint standpoint;
  for (int i = 0; i < 10; ++i) EXPECT_EQ(standpoint.news({0.5 * i, 0, 0}), 1.0);
}

TEST(Networks, EachSourceHasItsOwn) {
  Networks networks;
  const auto front = networks.number("front", 1, {}), rear = networks.number("rear", 2, {});
  EXPECT_NE(front, rear);
  EXPECT_EQ(networks.number("front", 3, {}), front);
  EXPECT_EQ(networks.find("front"), &networks[front]);
  EXPECT_EQ(networks.find("side"), nullptr);
}

TEST(Networks, TheOneThatWasNotHeardOfForLongestIsForgotten) {
  Networks networks;
  for (int i = 0; i < 8; ++i) networks.number(std::to_string(i), static_cast<std::uint64_t>(i + 1), {});
  networks.number("0", 9, {});
  networks.number("another", 10, {});
  EXPECT_NE(networks.find("0"), nullptr);
  EXPECT_EQ(networks.find("1"), nullptr);
  EXPECT_NE(networks.find("another"), nullptr);
}

}  // namespace
}  // namespace laneloom
