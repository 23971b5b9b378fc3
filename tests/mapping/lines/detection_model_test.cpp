#include "mapping/lines/detection_model.hpp"

#include <gtest/gtest.h>

namespace laneloom::lines {
namespace {

constexpr auto kLine = MarkingType::laneline, kEdge = MarkingType::roadedge;

/// Established lines have confidences about 0.7.
DetectionModel learned() {
  DetectionModel model;
  for (int i = 0; i < 200; ++i) model.learn_confidence(kLine, 10.0, i % 2 == 0 ? 0.6 : 0.8);
  return model;
}

Confidences confidences(double count, double mean) { return {.count = count, .mean = mean}; }

TEST(DetectionModel, KnowsNoLevelAtFirst) {
  DetectionModel model;
  EXPECT_FALSE(model.knows_confidences());
  EXPECT_EQ(model.log_odds(kLine, {}), 0.0);
  EXPECT_TRUE(learned().knows_confidences());
}

TEST(DetectionModel, AConfidenceIsComparedWithWhatEstablishedLinesHaveThere) {
  DetectionModel model = learned();
  EXPECT_NEAR(model.surplus(kLine, 10.0, 0.7), 0.0, 0.02);
  for (int i = 0; i < 500; ++i) model.learn_confidence(kLine, 30.0, 0.5);
  EXPECT_NEAR(model.surplus(kLine, 30.0, 0.5), 0.0, 0.02);
  EXPECT_NEAR(model.surplus(kLine, 10.0, 0.7) - model.surplus(kLine, 30.0, 0.7), -0.2, 0.05);
}

TEST(DetectionModel, LowConfidencesSpeakAgainstALineTheMoreTheMoreTheyAre) {
  const DetectionModel model = learned();
  EXPECT_LT(model.log_odds(kLine, confidences(1.0, -0.15)), -0.1);
  EXPECT_LT(model.log_odds(kLine, confidences(20.0, -0.15)), model.log_odds(kLine, confidences(1.0, -0.15)));
  EXPECT_GT(model.log_odds(kLine, confidences(20.0, 0.05)), 0.5);
}

TEST(DetectionModel, WhereWrongLinesScoreAsRightOnesConfidencesSayNothing) {
  DetectionModel model = learned();
  for (int i = 0; i < 300; ++i) model.learn_wrong(kLine, confidences(5.0, 0.0));
  EXPECT_NEAR(model.log_odds(kLine, confidences(20.0, -0.15)), 0.0, 0.1);
  EXPECT_LT(model.log_odds(kEdge, confidences(20.0, -0.15)), -1.0) << "each type by itself";
}

TEST(DetectionModel, ConfidencesThatErrTogetherCountAsFew) {
  DetectionModel lasting = learned(), passing = learned();
  for (int i = 0; i < 100; ++i) {
    lasting.learn_right(confidences(16.0, i % 2 == 0 ? 0.1 : -0.1));
    passing.learn_right(confidences(16.0, i % 2 == 0 ? 0.02 : -0.02));
  }
  EXPECT_GT(lasting.log_odds(kLine, confidences(30.0, -0.1)),
            2.0 / 3.0 * passing.log_odds(kLine, confidences(30.0, -0.1)));
}

TEST(DetectionModel, RatesAreLearnedByTypeAndPlaceWithinBounds) {
  DetectionModel model;
  const double before = model.rate(kLine, {5, 0, 0}), behind = model.rate(kLine, {-5, 0, 0});
  EXPECT_GT(before, behind);
  for (int i = 0; i < 5000; ++i) {
    model.learn_rate(kEdge, {5, 0, 0}, false);
    model.learn_rate(kEdge, {-5, 0, 0}, true);
  }
  EXPECT_EQ(model.rate(kLine, {5, 0, 0}), before);
  EXPECT_LT(model.rate(kEdge, {5, 0, 0}), 0.1);
  EXPECT_GT(model.rate(kEdge, {5, 0, 0}), 0.0);
  EXPECT_GT(model.rate(kEdge, {-5, 0, 0}), 0.9);
  EXPECT_LT(model.rate(kEdge, {-5, 0, 0}), 1.0);
}

}  // namespace
}  // namespace laneloom::lines
