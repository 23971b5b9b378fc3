#include "mapping/lines/frame_pitch.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mapping/shapes.hpp"

namespace laneloom::lines {
namespace {

/// A frame of lines in the body frame, seen by a vehicle that stands somewhere, turned.
class Pitch : public ::testing::Test {
 protected:
  /// A line `offset_m` to the left of the vehicle's own course, as a stretched frame shows it.
  Polyline beside(double offset_m, double stretch_per_m) const {
    Polyline points;
    for (double x = 4.0; x <= 50.0; x += 1.0) {
      const Point place(x, offset_m + curvature_per_m_ * x * x / 2.0, 0.0);
      points.push_back(place * (1.0 + stretch_per_m * (x - kPitchPivot_m)));
    }
    return points;
  }
  std::vector<SampledDetection> seen(const std::vector<Polyline>& lines) const {
    std::vector<markings::ObservedMarking> markings;
    for (Polyline line : lines) {
      for (Point& point : line) point = T_map_body_ * point;
      markings.push_back({.confidence = 0.9, .points = line});
    }
    return sample_detections(markings, {});
  }
  double stretch_per_m(const std::vector<Polyline>& lines) const {
    return estimate_stretch_per_m(seen(lines), T_map_body_);
  }

  Eigen::Isometry3d T_map_body_ = test::at(100, 50, 2.0);
  double curvature_per_m_ = 0.0;
};

TEST_F(Pitch, ThatOfAFrameIsFound) {
  for (const double true_per_m : {-0.004, 0.0, 0.003}) {
    EXPECT_NEAR(stretch_per_m({beside(5.3, true_per_m), beside(1.8, true_per_m), beside(-1.8, true_per_m)}),
                true_per_m, 0.15 * std::abs(true_per_m) + 1e-6);
  }
}

TEST_F(Pitch, IsToldFromABend) {
  curvature_per_m_ = 1.0 / 500.0;
  EXPECT_NEAR(stretch_per_m({beside(1.8, 0.0), beside(-1.8, 0.0)}), 0.0, 2e-4);
  EXPECT_NEAR(stretch_per_m({beside(1.8, 0.003), beside(-1.8, 0.003)}), 0.003, 7e-4);
}

TEST_F(Pitch, OneLineSaysNothing) { EXPECT_EQ(stretch_per_m({beside(1.8, 0.003)}), 0.0); }

TEST_F(Pitch, WhatRunsAcrossSaysNothing) {
  const Polyline across = test::straight({20, -10, 0}, {20, 10, 0});
  EXPECT_EQ(stretch_per_m({across, across}), 0.0);
}

TEST_F(Pitch, AnExitAmongTheLinesHardlyChangesIt) {
  Polyline exit;
  for (double x = 4.0; x <= 50.0; x += 1.0) exit.push_back({x, -5.3 - 0.0005 * x * x, 0.0});
  EXPECT_NEAR(stretch_per_m({beside(5.3, 0.0), beside(1.8, 0.0), beside(-1.8, 0.0), exit}), 0.0, 2e-3);
}

TEST_F(Pitch, IsTakenOutAgain) {
  auto frame = seen({beside(1.8, 0.004)});
  unstretch(0.004, T_map_body_, frame);
  Polyline truth = beside(1.8, 0.0);
  for (Point& point : truth) point = T_map_body_ * point;
  const double stretched_m = test::max_distance(seen({beside(1.8, 0.004)})[0].samples, truth);
  EXPECT_GT(stretched_m, 0.25);
  EXPECT_LT(test::max_distance(frame[0].samples, truth), 0.2 * stretched_m);
}

TEST_F(Pitch, MovesWhatIsFarBeyondTheFitNoFurtherThanInProportion) {
  for (const double x : {80.0, 91.3, 92.0, 200.0}) {
    const Point place = T_map_body_ * Point(x, 2, 0);
    EXPECT_LT(stretched_by(-0.012, place, T_map_body_).norm(), 2.0 * x);
    EXPECT_LT(stretched_by(0.012, place, T_map_body_).norm(), x);
  }
}

TEST_F(Pitch, WhatIsNearIsLeftAsItIs) {
  EXPECT_EQ(stretched_by(0.004, T_map_body_ * Point(5, 2, 0), T_map_body_), Eigen::Vector2d::Zero());
  EXPECT_EQ(stretched_by(0.004, T_map_body_ * Point(-30, 2, 0), T_map_body_), Eigen::Vector2d::Zero());
}

}  // namespace
}  // namespace laneloom::lines
