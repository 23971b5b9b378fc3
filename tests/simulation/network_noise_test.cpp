#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "laneloom/polyline.hpp"
#include "simulation/perception.hpp"
#include "simulation/scenarios.hpp"

/// The errors of real networks, on a straight road whose lines run along x.
namespace laneloom::simulation {
namespace {

struct Seen {
  DetectionFrame frame;
  std::vector<ElementId> sources;
  double x_m = 0.0;  ///< of the vehicle
};

std::vector<Seen> drive(const NoiseProfile& noise, std::uint64_t seed = 1) {
  const Road road = make_scenario("straight");
  Perception perception(road, noise, SensorView{}, seed);
  std::vector<Seen> seen;
  for (int i = 0; i < 200; ++i) {
    const VehiclePose pose = road.drive.pose_at(0.1 * i);
    DetectionFrame frame = perception.observe(pose);
    seen.push_back({std::move(frame), perception.sources(), pose.position.x()});
  }
  return seen;
}

double y_at(const Detection& detection, double x_m) {
  return MeasuredPolyline(detection.points).project({x_m, detection.points.front().y(), 0.0}).foot.y();
}

bool covers(const Detection& detection, double x_m) {
  const auto [low, high] = std::minmax_element(detection.points.begin(), detection.points.end(),
                                               [](const Point& a, const Point& b) { return a.x() < b.x(); });
  return low->x() <= x_m && x_m <= high->x();
}

TEST(NetworkNoise, WhatIsMissedForGoodIsMissedInEveryFrame) {
  NoiseProfile noise;
  noise.missed_share = {0.3, 0.3, 0.3};
  noise.missed_lasting = {1.0, 1.0, 1.0};
  // Counts by line and metre of the road: how often in view, and how often seen. The view's last ten metres
  // at either end do not count.
  std::map<std::pair<ElementId, int>, std::pair<int, int>> places;
  const std::size_t lines = make_scenario("straight").markings.size();
  for (const Seen& seen : drive(noise)) {
    for (double x_m = -30.0; x_m <= 40.0; x_m += 1.0) {
      const int place = static_cast<int>(std::floor(seen.x_m + x_m));
      const double at_m = place + 0.5 - seen.x_m;
      for (std::size_t line = 0; line < lines; ++line) ++places[{line + 1, place}].first;
      for (std::size_t i = 0; i < seen.sources.size(); ++i) {
        if (covers(seen.frame.detections[i], at_m)) ++places[{seen.sources[i], place}].second;
      }
    }
  }
  std::size_t missed = 0, sometimes = 0;
  for (const auto& [place, counts] : places) {
    if (counts.second == 0) ++missed;
    if (counts.second != 0 && counts.second != counts.first) ++sometimes;
  }
  EXPECT_GT(missed, places.size() / 10);
  EXPECT_LT(missed, places.size() / 2);
  EXPECT_LT(sometimes, places.size() / 20) << "where a stretch ends within the metre";
}

TEST(NetworkNoise, AnErrorThatLastsIsTheSameWheneverThePlaceIsSeen) {
  NoiseProfile noise;
  noise.offset_stddev_m = 0.2;
  noise.offset_lasting = 1.0;
  std::map<std::pair<ElementId, int>, std::pair<double, double>> extremes;
  for (const Seen& seen : drive(noise)) {
    for (std::size_t i = 0; i < seen.sources.size(); ++i) {
      for (int place = static_cast<int>(seen.x_m); place < seen.x_m + 30.0; place += 10) {
        if (place % 10 != 0 || !covers(seen.frame.detections[i], place - seen.x_m)) continue;
        const double y_m = y_at(seen.frame.detections[i], place - seen.x_m);
        auto& [low, high] = extremes.try_emplace({seen.sources[i], place}, y_m, y_m).first->second;
        low = std::min(low, y_m);
        high = std::max(high, y_m);
      }
    }
  }
  ASSERT_FALSE(extremes.empty());
  for (const auto& [place, range] : extremes) EXPECT_LT(range.second - range.first, 0.03);
}

double spread_m(const NoiseProfile& noise, double ahead_m) {
  double squares = 0.0;
  int count = 0;
  std::map<ElementId, double> truth_m;
  const std::vector<Seen> exact = drive({});
  for (std::size_t i = 0; i < exact.front().sources.size(); ++i)
    truth_m[exact.front().sources[i]] = y_at(exact.front().frame.detections[i], 0.0);
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    for (const Seen& seen : drive(noise, seed)) {
      for (std::size_t i = 0; i < seen.sources.size(); ++i, ++count) {
        const double error_m = y_at(seen.frame.detections[i], ahead_m) - truth_m.at(seen.sources[i]);
        squares += error_m * error_m;
      }
    }
  }
  return std::sqrt(squares / count);
}

TEST(NetworkNoise, GrowsWithTheSquareOfTheRange) {
  NoiseProfile noise;
  noise.offset_stddev_far_m = 0.2;
  noise.line_memory_s = 0.2;
  // Lines beside the vehicle have a range of up to 15 m where they are nearest.
  EXPECT_LT(spread_m(noise, 0.0), 0.05);
  EXPECT_NEAR(spread_m(noise, 40.0) / spread_m(noise, 20.0), 3.5, 0.6);
}

TEST(NetworkNoise, PitchScalesTheScene) {
  NoiseProfile noise;
  noise.frame_scale_stddev_per_m = 0.001;
  for (const Seen& seen : drive(noise)) {
    // A pitch widens or narrows all lines alike.
    std::vector<double> scales;
    for (const Detection& detection : seen.frame.detections) {
      const double near_m = y_at(detection, 0.0), far_m = y_at(detection, 30.0);
      if (std::abs(near_m) > 1.0) scales.push_back(far_m / near_m);
    }
    const auto [least, most] = std::minmax_element(scales.begin(), scales.end());
    ASSERT_LT(*most - *least, 0.005);
  }
}

TEST(NetworkNoise, DuplicatesAreOfNoMarking) {
  for (const double lasting : {0.0, 1.0}) {
    NoiseProfile noise;
    noise.duplicate = {.share = 1.0, .lasting = lasting, .dwell_s = 10.0};
    const Seen seen = drive(noise).front();
    const auto ghosts = std::count(seen.sources.begin(), seen.sources.end(), kNoElement);
    EXPECT_EQ(static_cast<std::size_t>(ghosts), make_scenario("straight").markings.size());
    EXPECT_EQ(seen.sources.size(), 2 * make_scenario("straight").markings.size());
  }
}

TEST(NetworkNoise, GhostsStayInTheirPlaces) {
  NoiseProfile noise;
  noise.ghost_rate_hz = {0.5, 0.5, 0.0};
  noise.ghost_dwell_s = 0.2;
  noise.ghost_lasting_share = 0.5;
  noise.ghost_lasting_dwell_s = 1e9;
  noise.ghost_beside_share = 1.0;
  std::map<std::pair<int, int>, int> frames;  // by lateral place, in decimetres, and first point, in metres
  for (const Seen& seen : drive(noise)) {
    for (std::size_t i = 0; i < seen.sources.size(); ++i) {
      if (seen.sources[i] != kNoElement) continue;
      const Point& begin = seen.frame.detections[i].points.front();
      if (begin.x() > -39.0)
        ++frames[{static_cast<int>(std::lround(10.0 * begin.y())),
                  static_cast<int>(std::lround(seen.x_m + begin.x()))}];
    }
  }
  const auto last_m = [&](int least) {
    return std::count_if(frames.begin(), frames.end(),
                         [&](const auto& ghost) { return ghost.second >= least; });
  };
  EXPECT_GT(last_m(1), last_m(15)) << "some go soon";
  EXPECT_GT(last_m(15), 2) << "some stay";
}

/// The correlation of consecutive confidences of the same line: how much of the scatter of one is in the
/// next.
double correlation(const NoiseProfile& noise) {
  std::map<ElementId, double> before;
  double products = 0.0, squares = 0.0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    before.clear();
    for (const Seen& seen : drive(noise, seed)) {
      for (std::size_t i = 0; i < seen.sources.size(); ++i) {
        const double error = seen.frame.detections[i].confidence - 0.5;
        if (before.contains(seen.sources[i])) {
          products += error * before[seen.sources[i]];
          squares += error * error;
        }
        before[seen.sources[i]] = error;
      }
    }
  }
  return products / squares;
}

TEST(NetworkNoise, ConfidencesErrForAWhile) {
  NoiseProfile noise;
  noise.confidence = 0.5;
  noise.confidence_stddev = 0.1;
  noise.confidence_memory_s = 5.0;
  noise.confidence_held = 0.0;
  EXPECT_NEAR(correlation(noise), 0.0, 0.05);
  noise.confidence_held = 1.0;
  EXPECT_NEAR(correlation(noise), 0.98, 0.02);
}

TEST(NetworkNoise, ConfidencesOfAFrameErrTogether) {
  NoiseProfile noise;
  noise.confidence = 0.5;
  noise.frame_confidence_stddev = 0.1;
  noise.confidence_memory_s = 1.0;
  double least = 1.0, most = 0.0;
  for (const Seen& seen : drive(noise)) {
    for (const Detection& detection : seen.frame.detections)
      EXPECT_EQ(detection.confidence, seen.frame.detections.front().confidence);
    least = std::min(least, seen.frame.detections.front().confidence);
    most = std::max(most, seen.frame.detections.front().confidence);
  }
  EXPECT_GT(most - least, 0.1);
}

TEST(NetworkNoise, AFrameTellsWhatWasInViewOnlyIfTheNetworkDoes) {
  NoiseProfile noise;
  noise.occluder_rate_hz = 5.0;
  std::size_t areas = 0;
  for (const Seen& seen : drive(noise)) areas += seen.frame.occluded_areas.size();
  EXPECT_GT(areas, 0U);
  noise.tells_view = false;
  for (const Seen& seen : drive(noise)) {
    EXPECT_TRUE(seen.frame.field_of_view.empty());
    EXPECT_TRUE(seen.frame.occluded_areas.empty());
  }
}

}  // namespace
}  // namespace laneloom::simulation
