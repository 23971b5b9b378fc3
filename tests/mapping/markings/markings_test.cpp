#include "mapping/markings/markings.hpp"

#include <gtest/gtest.h>

#include "mapping/shapes.hpp"

namespace laneloom::markings {
namespace {

Marking styled() {
  Marking m = test::marking(3, {{0, 0, 0}, {10, 0, 0}});
  m.styles = {{{0, 4}, MarkingStyle::solid}, {{4, 10}, MarkingStyle::dashed}};
  return m;
}

TEST(Markings, ASliceHasTheStylesOfItsStretch) {
  const Marking part = slice(styled(), {3, 9});
  EXPECT_DOUBLE_EQ(length(part.points), 6.0);
  ASSERT_EQ(part.styles.size(), 2U);
  EXPECT_DOUBLE_EQ(part.styles[0].range.to_m, 1.0);
  EXPECT_EQ(part.styles[1].style, MarkingStyle::dashed);
  EXPECT_DOUBLE_EQ(part.styles[1].range.to_m, 6.0);
  EXPECT_EQ(slice(styled(), {5, 9}).styles.size(), 1U);
}

TEST(Markings, ASliceHasTheDeviationsOfItsPlaces) {
  Marking marking{.points = {{0, 0, 0}, {10, 0, 0}, {20, 0, 0}}, .lateral_stddev_m = {0.1, 0.2, 0.6}};
  const Marking part = slice(marking, {5.0, 17.5});
  ASSERT_EQ(part.points.size(), 3U);
  ASSERT_EQ(part.lateral_stddev_m.size(), 3U);
  EXPECT_NEAR(part.lateral_stddev_m[0], 0.15, 1e-9);
  EXPECT_NEAR(part.lateral_stddev_m[1], 0.2, 1e-9);
  EXPECT_NEAR(part.lateral_stddev_m[2], 0.5, 1e-9);
}

TEST(Markings, ExistenceOfAChainIsTheMeanByLength) {
  Marking marking{.points = {{0, 0, 0}, {10, 0, 0}}, .existence_probability = 0.9};
  append(marking, Marking{.points = {{12, 0, 0}, {42, 0, 0}}, .existence_probability = 0.5});
  EXPECT_NEAR(marking.existence_probability, 0.6, 1e-9);
  append(marking, Marking{.points = {{43, 0, 0}, {44, 0, 0}}});
  EXPECT_EQ(marking.existence_probability, -1.0);
}

TEST(Markings, AChainHasTheStatusOfTheLongerPart) {
  const auto chain = [](double first_m, double second_m) {
    Marking marking{.status = ElementStatus::tentative, .points = {{0, 0, 0}, {first_m, 0, 0}}};
    append(marking, Marking{.points = {{first_m, 0, 0}, {first_m + second_m, 0, 0}}});
    return marking.status;
  };
  EXPECT_EQ(chain(3, 30), ElementStatus::confirmed);
  EXPECT_EQ(chain(30, 3), ElementStatus::tentative);
}

TEST(Markings, ReversedTwiceIsTheSame) {
  Marking m = styled();
  reverse(m);
  EXPECT_EQ(m.points.front(), Point(10, 0, 0));
  EXPECT_EQ(m.styles[0].style, MarkingStyle::dashed);
  EXPECT_DOUBLE_EQ(m.styles[0].range.to_m, 6.0);
  reverse(m);
  EXPECT_EQ(m.points, styled().points);
  EXPECT_DOUBLE_EQ(m.styles[0].range.to_m, 4.0);
}

TEST(Markings, AppendingBridgesTheGapWithUnknownStyle) {
  Marking m = styled();
  Marking next = test::marking(9, {{12, 0, 0}, {15, 0, 0}});
  next.styles = {{{0, 3}, MarkingStyle::dashed}};
  next.first_seen_ns = -5;
  next.last_seen_ns = 8;
  append(m, next);
  EXPECT_EQ(m.id, 3U);
  EXPECT_EQ(m.first_seen_ns, -5);
  EXPECT_EQ(m.last_seen_ns, 8);
  ASSERT_EQ(m.styles.size(), 4U);
  EXPECT_EQ(m.styles[2].style, MarkingStyle::unknown);
  EXPECT_DOUBLE_EQ(m.styles[2].range.length(), 2.0);
  EXPECT_DOUBLE_EQ(m.styles[3].range.to_m, length(m.points));
}

}  // namespace
}  // namespace laneloom::markings
