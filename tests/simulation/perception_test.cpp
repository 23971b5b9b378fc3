#include "simulation/perception.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "laneloom/polyline.hpp"
#include "simulation/scenarios.hpp"
#include "thrown_by.hpp"

namespace laneloom::simulation {
namespace {

std::vector<DetectionFrame> drive(const Road& road, const NoiseProfile& noise, double duration_s,
                                  std::uint64_t seed = 1, const SensorView& view = {}) {
  Perception perception(road, noise, view, seed);
  std::vector<DetectionFrame> frames;
  for (int i = 0; i < 10.0 * duration_s; ++i)
    frames.push_back(perception.observe(road.drive.pose_at(0.1 * i)));
  return frames;
}

double distance_to_markings_m(const Road& road, MarkingType type, const Point& p) {
  double nearest_m = 1e9;
  for (const RoadMarking& marking : road.markings) {
    if (marking.type != type) continue;
    const Projection foot = MeasuredPolyline(marking.points).project(p);
    nearest_m = std::min(nearest_m, (foot.foot - p).norm());
  }
  return nearest_m;
}

bool same(const DetectionFrame& a, const DetectionFrame& b) {
  return a.stamp_ns == b.stamp_ns && a.sequence == b.sequence && a.occluded_areas == b.occluded_areas &&
         std::equal(a.detections.begin(), a.detections.end(), b.detections.begin(), b.detections.end(),
                    [](const Detection& x, const Detection& y) {
                      return x.type == y.type && x.style == y.style && x.confidence == y.confidence &&
                             x.points == y.points;
                    });
}

TEST(NoNoise, DetectionsLieOnTheTruth) {
  for (const char* name : {"curve", "intersection", "hill", "overpass"}) {
    const Road road = make_scenario(name);
    for (const DetectionFrame& frame : drive(road, noise_profile("none"), 15.0)) {
      const Eigen::Isometry3d T_map_body =
          transform(road.drive.pose_at(static_cast<double>(frame.stamp_ns) * 1e-9));
      ASSERT_FALSE(frame.detections.empty());
      EXPECT_TRUE(frame.occluded_areas.empty());
      for (const Detection& detection : frame.detections) {
        EXPECT_EQ(detection.confidence, 1.0);
        EXPECT_GE(detection.points.size(), 20u);
        for (const Point& p : detection.points)
          ASSERT_LT(distance_to_markings_m(road, detection.type, T_map_body * p), 1e-3) << name;
      }
    }
  }
}

TEST(NoNoise, EverythingInViewIsSeen) {
  const Road road = make_scenario("straight");
  const DetectionFrame frame = drive(road, noise_profile("none"), 5.0).back();
  EXPECT_EQ(frame.detections.size(), road.markings.size());
  for (const Detection& detection : frame.detections) {
    EXPECT_NEAR(detection.points.front().x(), -40.0, 1e-6);
    EXPECT_NEAR(detection.points.back().x(), 50.0, 1e-6);
  }
  EXPECT_EQ(frame.field_of_view.size(), 4u);
}

TEST(NoNoise, FromTheBridgeTheRoadBelowIsNotSeen) {
  const Road road = make_scenario("overpass");
  Perception perception(road, {}, {}, 1);
  const DetectionFrame frame = perception.observe(road.drive.pose_at(10.0));
  ASSERT_EQ(frame.detections.size(), 3u);
  for (const Detection& detection : frame.detections) {
    for (const Point& p : detection.points) EXPECT_LT(std::abs(p.y()), 6.0);
  }
}

TEST(NoNoise, ANetworkWithoutStoplinesGivesNone) {
  SensorView view;
  view.detected_types = {MarkingType::laneline, MarkingType::roadedge};
  for (const DetectionFrame& frame : drive(make_scenario("intersection"), {}, 10.0, 1, view)) {
    EXPECT_EQ(frame.detected_types, view.detected_types);
    for (const Detection& detection : frame.detections) EXPECT_NE(detection.type, MarkingType::stopline);
  }
}

TEST(Noise, IsTheSameForTheSameSeedOnly) {
  const Road road = make_scenario("town");
  const auto a = drive(road, noise_profile("inhouse"), 20.0, 7),
             b = drive(road, noise_profile("inhouse"), 20.0, 7),
             c = drive(road, noise_profile("inhouse"), 20.0, 8);
  EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end(), same));
  EXPECT_FALSE(std::equal(a.begin(), a.end(), c.begin(), c.end(), same));
}

TEST(Noise, FramesAreWellFormed) {
  const Road road = make_scenario("town");
  for (const std::string& name : noise_profile_names()) {
    std::uint64_t sequence = 0;
    for (const DetectionFrame& frame : drive(road, noise_profile(name), 60.0)) {
      EXPECT_EQ(frame.sequence, ++sequence);
      for (const Detection& detection : frame.detections) {
        EXPECT_GE(detection.points.size(), 2u);
        EXPECT_GE(detection.confidence, 0.0);
        EXPECT_LE(detection.confidence, 1.0);
        for (const Point& p : detection.points) EXPECT_TRUE(p.allFinite());
      }
    }
  }
}

TEST(Noise, MissesHappenAndLast) {
  NoiseProfile noise;
  noise.missed_share = {0.3, 0.3, 0.3};
  noise.missed_dwell_s = 1.0;
  // On the straight, all eight markings are in view all the time.
  int missed = 0, began = 0, frames = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::vector<bool> before(8, false);
    for (const DetectionFrame& frame : drive(make_scenario("straight"), noise, 20.0, seed)) {
      std::vector<bool> now(8, true);
      for (const Detection& detection : frame.detections) {
        const double y = detection.points.front().y();
        const std::vector<double> offsets{0.12, -0.12, -3.62, -7.12, -10.62, 3.62, 7.12, 10.62};
        for (std::size_t i = 0; i < 8; ++i) {
          if (std::abs(y - (offsets[i] + 5.37)) < 0.1) now[i] = false;
        }
      }
      for (std::size_t i = 0; i < 8; ++i) {
        ++frames;
        missed += now[i] ? 1 : 0;
        began += now[i] && !before[i] ? 1 : 0;
      }
      before = now;
    }
  }
  EXPECT_NEAR(static_cast<double>(missed) / frames, 0.3, 0.05);
  EXPECT_NEAR(0.1 * missed / began, 1.0, 0.2) << "mean time of a miss";
}

// Lateral error of the ego lane's lines on the straight, at a distance ahead, per frame.
std::vector<double> lateral_errors_m(const NoiseProfile& noise, double ahead_m) {
  std::vector<double> errors;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    for (const DetectionFrame& frame : drive(make_scenario("straight"), noise, 20.0, seed)) {
      for (const Detection& detection : frame.detections) {
        const Point p = MeasuredPolyline(detection.points).project({ahead_m, 1.75, 0.0}).foot;
        const double error_m = p.y() - 1.75;  // the line left of the ego lane
        if (std::abs(error_m) < 1.2) errors.push_back(error_m);
      }
    }
  }
  return errors;
}

double spread_m(const std::vector<double>& errors) {
  double squares = 0.0;
  for (const double error : errors) squares += error * error;
  return std::sqrt(squares / static_cast<double>(errors.size()));
}

TEST(Noise, GrowsWithRangeAndLastsOverFrames) {
  NoiseProfile noise;
  noise.offset_stddev_m = 0.1;
  noise.offset_stddev_per_m = 0.005;
  noise.line_memory_s = 1.0;
  const auto near = lateral_errors_m(noise, 0.0), far = lateral_errors_m(noise, 30.0);
  EXPECT_NEAR(spread_m(near), 0.11, 0.02);
  EXPECT_NEAR(spread_m(far), 0.25, 0.04);
  double steps = 0.0;
  for (std::size_t i = 1; i < near.size(); ++i) steps += (near[i] - near[i - 1]) * (near[i] - near[i - 1]);
  const double step_m = std::sqrt(steps / static_cast<double>(near.size()));
  EXPECT_LT(step_m, 0.6 * spread_m(near)) << "independent errors would have a step of 1.4 times their spread";
}

TEST(Noise, EveryKindOfErrorHappens) {
  const Road road = make_scenario("town");
  std::size_t hidden = 0, swapped = 0, unknown = 0, ghosts = 0;
  for (const DetectionFrame& frame : drive(road, noise_profile("inhouse"), 100.0)) {
    const Eigen::Isometry3d T_map_body =
        transform(road.drive.pose_at(static_cast<double>(frame.stamp_ns) * 1e-9));
    hidden += frame.occluded_areas.size();
    for (const Detection& detection : frame.detections) {
      if (detection.style == MarkingStyle::unknown) ++unknown;
      if (detection.type == MarkingType::stopline) continue;
      const bool edge = detection.type == MarkingType::roadedge;
      const Point middle = T_map_body * detection.points[detection.points.size() / 2];
      const double own_m = distance_to_markings_m(road, detection.type, middle);
      const double other_m =
          distance_to_markings_m(road, edge ? MarkingType::laneline : MarkingType::roadedge, middle);
      if (own_m > 1.8 && other_m < 0.3) ++swapped;
      if (own_m > 2.0 && other_m > 2.0) ++ghosts;
    }
  }
  EXPECT_GT(hidden, 20u);
  EXPECT_GT(swapped, 20u);
  EXPECT_GT(unknown, 20u);
  EXPECT_GT(ghosts, 20u);
}

TEST(NoiseProfile, AnUnknownNameNamesTheKnownOnes) {
  EXPECT_THAT(thrown_by<std::invalid_argument>([&] { noise_profile("loud"); }),
              testing::HasSubstr("inhouse"));
}

}  // namespace
}  // namespace laneloom::simulation
