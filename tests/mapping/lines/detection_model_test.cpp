#include "mapping/lines/detection_model.hpp"

#include <gtest/gtest.h>

namespace laneloom::lines {
namespace {

constexpr auto kLine = MarkingType::laneline, kEdge = MarkingType::roadedge;

DetectionModel taught(double confidence) {
  DetectionModel model;
  for (int i = 0; i < 2000; ++i) model.learn_confidence(confidence);
  return model;
}

TEST(DetectionModel, TakesConfidencesAsTheyAreAtFirst) {
  const DetectionModel model;
  EXPECT_FALSE(model.knows_confidences());
  EXPECT_DOUBLE_EQ(model.belief(0.5), 0.5);
  EXPECT_TRUE(taught(0.9).knows_confidences());
}

TEST(DetectionModel, NetworksThatAreSureAndUnsureAreBelievedAlike) {
  EXPECT_NEAR(taught(0.9).belief(0.9), kUsualBelief, 0.01);
  EXPECT_NEAR(taught(0.3).belief(0.3), kUsualBelief, 0.01);
  EXPECT_NEAR(taught(0.9).belief(0.45), 0.5 * kUsualBelief, 0.01);
}

TEST(DetectionModel, BeliefIsAProbability) {
  EXPECT_EQ(taught(0.3).belief(1.0), 1.0);
  EXPECT_EQ(taught(0.0).belief(1.0), 1.0);
  EXPECT_EQ(taught(0.0).belief(0.0), 0.0);
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
