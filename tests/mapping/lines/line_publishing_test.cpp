#include "mapping/lines/line_publishing.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "laneloom/polyline.hpp"
#include "mapping/shapes.hpp"

namespace laneloom::lines {
namespace {

using test::line;
using test::straight;

class LinePublishing : public ::testing::Test {
 protected:
  std::vector<Marking> publish() { return publish_lines({line_}, {}, {}); }
  void believe(std::size_t from, std::size_t to, double log_odds) {
    for (std::size_t i = from; i < to; ++i) line_.stations[i].log_odds = log_odds;
  }
  Line line_ = line(4, straight({-12, 0, 0}, {38, 0, 0}, 51));
};

TEST_F(LinePublishing, WhatHasEvidenceAsFarAsItReaches) {
  believe(0, 51, -1.1);
  EXPECT_TRUE(publish().empty());
  believe(0, 40, 1.0);
  const auto markings = publish();
  ASSERT_EQ(markings.size(), 1U);
  EXPECT_EQ(markings[0].id, 4U);
  EXPECT_NEAR(markings[0].points.front().x(), -12.0, 1e-9);
  EXPECT_NEAR(markings[0].points.back().x(), 27.0, 1e-9);
  EXPECT_EQ(markings[0].status, ElementStatus::tentative);
  believe(0, 40, 3.0);
  EXPECT_EQ(publish()[0].status, ElementStatus::confirmed);
}

TEST_F(LinePublishing, AWeakStretchInTheMiddleIsPublishedWithTheLine) {
  believe(0, 51, 3.0);
  believe(20, 35, -2.0);
  const auto markings = publish();
  ASSERT_EQ(markings.size(), 1U);
  EXPECT_NEAR(length(markings[0].points), 50.0, 1e-9);
}

TEST_F(LinePublishing, ALineExistsByItsMeanAndTheBeliefsInIt) {
  believe(0, 51, 0.0);
  EXPECT_TRUE(publish().empty());
  line_.beliefs = {.count = 20.0, .mean = 0.7};
  EXPECT_EQ(publish().size(), 1U);
  believe(0, 51, 3.0);
  line_.beliefs = {.count = 20.0, .mean = 0.3};
  EXPECT_TRUE(publish().empty());
}

TEST_F(LinePublishing, ANearParallelIsHeldBackUntilBothAreSeenTogether) {
  believe(0, 51, 3.0);
  Line parallel = line(5, straight({-2, 0.7, 0}, {28, 0.7, 0}, 31));
  for (Station& station : parallel.stations) station.log_odds = 3.0;
  const auto count = [&](double together, double apart) {
    return publish_lines({line_, parallel}, {{.a = 4, .b = 5, .together = together, .apart = apart}}, {})
        .size();
  };
  EXPECT_EQ(count(0.0, 0.0), 1U);
  EXPECT_EQ(count(0.0, 1.0), 1U);
  EXPECT_EQ(count(1.0, 0.0), 2U) << "lines that converge";
  EXPECT_EQ(count(3.0, 1.0), 2U);
  EXPECT_EQ(count(3.0, 6.0), 1U);
  EXPECT_EQ(publish_lines({line_, parallel}, {{.a = 4, .b = 5}}, {})[0].id, 4U) << "the longer one stays";
  for (Station& station : parallel.stations) station.type_votes = {0.0, 1.0, 0.0};
  EXPECT_EQ(count(0.0, 0.0), 2U) << "a line along a kerb";
}

TEST_F(LinePublishing, CertaintyGrowsWithEvidenceAndNearness) {
  const FusionConfig config;
  for (std::size_t i = 0; i < 51; ++i)
    line_.stations[i].lateral = LateralFilter({.stddev_m = i < 25 ? 0.0 : 0.2});
  believe(0, 51, config.publish_log_odds);
  const Marking unsure = publish()[0];
  EXPECT_NEAR(unsure.existence_probability, config.existence_at_publish, 1e-9);
  ASSERT_EQ(unsure.lateral_stddev_m.size(), unsure.points.size());
  EXPECT_NEAR(unsure.lateral_stddev_m.front(), config.bias_stddev_m, 1e-6);
  EXPECT_NEAR(unsure.lateral_stddev_m.back(), std::hypot(config.bias_stddev_m, 0.2), 1e-6);
  believe(0, 51, 4.9);
  EXPECT_LT(publish()[0].existence_probability, config.existence_at_max);
  for (const double sure : {5.0, config.max_log_odds}) {
    believe(0, 51, sure);
    EXPECT_NEAR(publish()[0].existence_probability, config.existence_at_max, 1e-9);
  }
}

TEST_F(LinePublishing, ManyViewsOfLowBeliefSayMoreThanOneAndNoMoreThanTheLimit) {
  believe(0, 51, 1.0);
  const auto published_with = [&](Beliefs beliefs) {
    line_.beliefs = beliefs;
    return !publish().empty();
  };
  EXPECT_TRUE(published_with({.count = 1.0, .mean = 0.5}));
  EXPECT_FALSE(published_with({.count = 20.0, .mean = 0.5}));
  believe(0, 51, 4.6);
  EXPECT_TRUE(published_with({.count = 100.0, .mean = 0.0})) << "beliefs take at most 4";
  believe(0, 51, -0.6);
  EXPECT_FALSE(published_with({.count = 100.0, .mean = 1.0})) << "beliefs give at most 1";
}

TEST_F(LinePublishing, ZigzagBetweenStationsIsSmoothed) {
  for (std::size_t i = 0; i < 51; ++i) line_.stations[i].position.y() = i % 2 == 0 ? 0.1 : -0.1;
  believe(0, 51, 1.0);
  const Marking marking = publish()[0];
  ASSERT_EQ(marking.points.size(), 51U);
  for (std::size_t i = 1; i < 50; ++i) EXPECT_LT(std::abs(marking.points[i].y()), 0.06) << i;
}

TEST_F(LinePublishing, ABendOfTwelveMetresStaysOne) {
  line_ = line(4, test::arc({0, 12, 0}, 12, -90, 0));
  for (Station& station : line_.stations) station.log_odds = 1.0;
  EXPECT_LT(test::max_distance(publish()[0].points, test::arc({0, 12, 0}, 12, -90, 0)), 0.03);
}

TEST_F(LinePublishing, StylesFollowTheVotes) {
  believe(0, 51, 1.0);
  for (std::size_t i = 0; i < 51; ++i)
    line_.stations[i].style_votes = {9.0, i < 20 ? 5.0 : 0.0, i < 20 ? 1.0 : 5.0};
  const auto styles = publish()[0].styles;
  ASSERT_EQ(styles.size(), 2U);
  EXPECT_EQ(styles[0].style, MarkingStyle::solid);
  EXPECT_NEAR(styles[0].range.to_m, 20.0, 1.01);
  EXPECT_EQ(styles[1].style, MarkingStyle::dashed);
}

TEST_F(LinePublishing, AStoplineHasTwoPoints) {
  line_ = line(4, straight({10, -3, 0}, {10, 3, 0}, 7), MarkingType::stopline);
  for (Station& station : line_.stations) station.log_odds = 1.0;
  EXPECT_EQ(publish()[0].points.size(), 2U);
}

}  // namespace
}  // namespace laneloom::lines
