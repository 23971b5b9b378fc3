#include "mapping/lines/frame_alignment.hpp"

#include <gmock/gmock.h>

#include "mapping/shapes.hpp"

namespace laneloom::lines {
namespace {

using test::straight;

/// The vehicle at (100, 50), heading north-west, before three reliable lines along and a stopline across its
/// way; detections of them, all displaced by one error.
class Alignment : public ::testing::Test {
 protected:
  Alignment() {
    add(straight({-5, 3.5, 0}, {30, 3.5, 0}, 36));
    add(straight({-5, 0, 0}, {30, 0, 0}, 36));
    add(straight({-5, -3.5, 0}, {30, -3.5, 0}, 36));
    add(straight({20, -3.5, 0}, {20, 3.5, 0}, 15), MarkingType::stopline);
  }

  void add(const Polyline& body, MarkingType type = MarkingType::laneline) {
    lines_.push_back(test::line(lines_.size() + 1, in_map(body, FrameError::Zero()), type));
    for (Station& station : lines_.back().stations) station.log_odds = 5.0;
    bodies_.emplace_back(body, type);
  }

  Polyline in_map(Polyline body, const FrameError& error) const {
    for (Point& p : body)
      p = T_map_body_ * (Eigen::Translation3d(error.x(), error.y(), 0.0) *
                         Eigen::AngleAxisd(error.z(), Point::UnitZ()) * p);
    return body;
  }

  std::vector<SampledDetection> detections(const FrameError& error) const {
    std::vector<markings::ObservedMarking> markings;
    for (const auto& [body, type] : bodies_)
      markings.push_back({.type = type, .confidence = 0.9, .points = in_map(body, error)});
    return sample_detections(markings, {});
  }

  void align(std::vector<SampledDetection>& frame) {
    LineMatcher matcher(lines_, config_.fusion);
    align_frame(T_map_body_, gain_, matcher, frame, lasting_);
  }

  /// How far the detections lie beside their lines after aligning them.
  double residual_m(const FrameError& error) {
    auto frame = detections(error);
    align(frame);
    double largest_m = 0.0;
    for (std::size_t i = 0; i + 1 < frame.size(); ++i)
      largest_m = std::max(
          largest_m, test::max_distance(frame[i].samples, in_map(bodies_[i].first, FrameError::Zero())));
    return largest_m;
  }

  Eigen::Isometry3d T_map_body_ = test::at(100, 50, 2.0);
  std::vector<std::pair<Polyline, MarkingType>> bodies_;
  std::vector<Line> lines_;
  MapperConfig config_;
  double gain_ = 1.0;
  FrameError lasting_ = FrameError::Zero();
};

TEST_F(Alignment, FindsWhatAllDetectionsHaveInCommon) {
  const FrameError error{0.3, 0.0, 0.01};
  const auto frame = detections(error);
  const auto matches = LineMatcher(lines_, config_.fusion).match(frame);
  const FrameError found = estimate_errors(matches, frame, lines_, T_map_body_, 2.0).likely;
  // Drawn towards none, the less the more lines tell.
  EXPECT_GT(found.z(), 0.006);
  EXPECT_LT(found.z(), 0.01);
  EXPECT_GT(found.x(), 0.12);
  EXPECT_LT(found.x(), 0.3);
  EXPECT_NEAR(found.y(), 0.0, 0.02);
}

TEST_F(Alignment, TakesATurnOutOfTheFrame) {
  const FrameError turned{0.0, 0.0, 0.015};
  EXPECT_LT(residual_m(turned), 0.2);  // of 0.45 m at 30 m
}

TEST_F(Alignment, ThatDidNotComeTrueLeavesTheFrameAsItIs) {
  gain_ = 0.0;
  EXPECT_GT(residual_m({0.0, 0.0, 0.015}), 0.4);
}

TEST_F(Alignment, OneLineAmongOthersDoesNotTurnTheFrame) {
  auto frame = detections(FrameError::Zero());
  for (Point& p : frame[0].samples) p += Point(-0.3, 0.2, 0.0);
  const Polyline right = frame[1].samples;
  align(frame);
  EXPECT_LT(test::max_distance(frame[1].samples, right), 0.05);
}

TEST_F(Alignment, LinesWithoutEvidenceSayNothing) {
  for (Line& line : lines_)
    for (Station& station : line.stations) station.log_odds = 0.0;
  EXPECT_GT(residual_m({0.0, 0.0, 0.015}), 0.4);
}

TEST_F(Alignment, WhatLastsIsADriftAndGoesIntoTheMap) {
  const FrameError turned{0.0, 0.0, 0.015};
  for (int i = 0; i < 400; ++i) residual_m(turned);
  EXPECT_GT(residual_m(turned), 0.4);
}

}  // namespace
}  // namespace laneloom::lines
