#include "mapping/lines/station_update.hpp"

#include <gtest/gtest.h>

#include "mapping/lines/frame_pitch.hpp"
#include "mapping/shapes.hpp"

namespace laneloom::lines {
namespace {

/// A station at the origin of a line along x; the vehicle comes along.
class StationUpdate : public ::testing::Test {
 protected:
  StationUpdate() { networks_.number("front", 1, {}); }

  /// Sees the station `lateral_m` beside the origin from `range_m` before it.
  void see(double range_m, double lateral_m, PitchParts stretch = {}) {
    const Viewpoint from{.T_map_body = test::at(-range_m),
                         .source = 0,
                         .stretch = stretch,
                         .gains = networks_[0].lateral.gains()};
    const Observation seen{.lateral_m = lateral_m - station_.position.y(), .height_m = 0.0, .stddev_m = 0.1};
    learn(seen, from, station_, networks_);
    observe(seen, from, station_);
  }
  double stddev_m(double range_m) { return networks_[0].lateral.stddev_m(range_m); }

  Networks networks_;
  Station station_;
};

TEST_F(StationUpdate, MovesToTheSideOnly) {
  station_.lateral = LateralFilter({.stddev_m = 0.1});
  observe({.direction = {0, 1}, .lateral_m = 0.4, .height_m = 0.2, .stddev_m = 0.1}, {}, station_);
  EXPECT_LT(station_.position.x(), -0.1);
  EXPECT_EQ(station_.position.y(), 0.0);
  EXPECT_NEAR(station_.position.z(), -0.5 * station_.position.x(), 1e-9);
}

TEST_F(StationUpdate, ANearViewTeachesHowWrongAFarOneWas) {
  const double before_m = stddev_m(26.0);
  for (int i = 0; i < 200; ++i) {
    see(26.0, i % 2 == 0 ? 0.3 : -0.3);
    EXPECT_NE(station_.far_views[3].source, FarView::kNone);
    see(8.0, 0.0);
    EXPECT_EQ(station_.far_views[3].source, FarView::kNone);
  }
  EXPECT_GT(stddev_m(26.0), 1.5 * before_m);
  EXPECT_NEAR(stddev_m(48.0), FusionConfig{}.stddev_m + 48.0 * FusionConfig{}.stddev_per_m, 1e-9);
}

TEST_F(StationUpdate, AFarViewOfRightPlacesTeachesTrust) {
  const double before_m = stddev_m(26.0);
  for (int i = 0; i < 200; ++i) {
    see(26.0, 0.0);
    see(8.0, 0.0);
  }
  EXPECT_LT(stddev_m(26.0), 0.7 * before_m);
}

TEST_F(StationUpdate, ThePitchIsJudgedByWhatWasSaidBeforeItWasTakenOut) {
  station_.position.y() = 4.0;
  for (int i = 0; i < 400; ++i) {
    const PitchParts stretch{.sudden_per_m = i % 2 == 0 ? 0.005 : -0.005,
                             .lasting_per_m = i % 3 == 0 ? 0.003 : -0.003};
    const auto wrong_m = [](double per_m) { return stretched_by(per_m, {0, 4, 0}, test::at(-26.0)).y(); };
    const PerSuspicion gains = networks_[0].lateral.gains();
    see(26.0,
        4.0 + (1.0 - gains[kSuddenPitch]) * wrong_m(stretch.sudden_per_m) -
            gains[kLastingPitch] * wrong_m(stretch.lasting_per_m),
        stretch);
    see(8.0, 4.0);
  }
  EXPECT_GT(networks_[0].lateral.gains()[kSuddenPitch], 0.9);
  EXPECT_LT(networks_[0].lateral.gains()[kLastingPitch], 0.1) << "it is not true";
}

TEST_F(StationUpdate, SamplesWeighAsTheirNetworkSaysOrHasProved) {
  std::vector<SampledDetection> detections(2);
  for (SampledDetection& detection : detections) detection.samples = {{0, 0, 0}, {30, 0, 0}};
  detections[1].stddev_m = {0.5, 0.0};
  weigh(networks_[0].lateral, Point::Zero(), detections);
  EXPECT_EQ(detections[0].stddev_m, (std::vector{stddev_m(0.0), stddev_m(30.0)}));
  EXPECT_EQ(detections[1].stddev_m, (std::vector{0.5, 0.02}));
}

}  // namespace
}  // namespace laneloom::lines
