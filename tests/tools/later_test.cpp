#include "evaluation/later.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace laneloom {
namespace {

constexpr std::size_t k12m = 0, k20m = 1, k28m = 2;
constexpr std::int64_t kStep_ns = 100'000'000;
constexpr double kLeft_m = 1.75, kRight_m = -1.75;

/// A line beside the vehicle as it is told from the vehicle, off by so much at a distance ahead.
using Error = std::function<double(double ahead_m)>;

Polyline beside(double y, const Error& error) {
  Polyline points;
  for (double x = 0.0; x <= 40.0; x += 1.0) points.emplace_back(x, y + error(x), 0.0);
  return points;
}

double exact(double /*ahead_m*/) { return 0.0; }
double off_afar(double ahead_m) { return ahead_m > 11.0 ? 0.2 : 0.0; }

/// A straight drive at 10 m/s, a frame a metre, between two lanelines. What a test changes is what is wrong.
struct StraightDrive {
  int frames = 101;
  double step_m = 1.0;
  Error single_error = exact, map_error = exact;
  std::vector<double> single{kLeft_m, kRight_m}, map{kLeft_m, kRight_m};
  std::function<ElementId(int)> own_lane = [](int) { return 1; };

  LocalMap map_at(int frame, const Eigen::Isometry3d& T_map_body) const {
    LocalMap result;
    const auto in_map = [&](Polyline points) {
      for (Point& point : points) point = T_map_body * point;
      return points;
    };
    for (const double y : map) {
      Marking boundary;
      boundary.points = in_map(beside(y, map_error));
      result.boundaries.push_back(boundary);
    }
    if (own_lane(frame) == kNoElement) return result;
    Lane lane{.id = own_lane(frame)};
    lane.left = in_map(beside(kLeft_m, exact));
    lane.right = in_map(beside(kRight_m, exact));
    result.lanes = {lane};
    return result;
  }

  evaluation::LaterMeter rate() const {
    evaluation::LaterMeter meter(0.3);
    Eigen::Isometry3d T_map_body = Eigen::Isometry3d::Identity();
    for (int i = 0; i < frames; ++i, T_map_body.translation().x() += step_m) {
      DetectionFrame frame{.stamp_ns = i * kStep_ns};
      for (const double y : single)
        frame.detections.push_back({.confidence = 0.9, .points = beside(y, single_error)});
      frame.detections.push_back({.confidence = 0.1, .points = beside(0.0, exact)});  // too little to count
      meter.add(frame, T_map_body, map_at(i, T_map_body));
    }
    return meter;
  }
};

const evaluation::LaterScore& lanelines(const evaluation::LaterMeter& meter, std::size_t distance) {
  return meter.score(MarkingType::laneline, distance);
}

TEST(Later, ALineWithAPointFarAwayIsNoWitness) {
  evaluation::LaterMeter meter(0.3);
  Eigen::Isometry3d T_map_body = Eigen::Isometry3d::Identity();
  for (int i = 0; i < 101; ++i, T_map_body.translation().x() += 1.0) {
    DetectionFrame frame{.stamp_ns = i * kStep_ns};
    frame.detections.push_back({.confidence = 0.9, .points = {{0, kLeft_m, 0}, {1e7, kLeft_m, 0}}});
    meter.add(frame, T_map_body, {});
  }
  EXPECT_EQ(meter.frames(), 53u);
  EXPECT_FALSE(meter.any());
}

TEST(Later, APerfectMapHasNoErrorAndMissesNothing) {
  const evaluation::LaterMeter meter = StraightDrive{}.rate();
  EXPECT_EQ(meter.frames(), 53u);  // of 101: not the first 2 s, nor the last 28 m
  EXPECT_NEAR(meter.driven_m(), 53.0, 1e-9);
  for (const std::size_t distance : {k12m, k20m, k28m}) {
    const evaluation::LaterScore& score = lanelines(meter, distance);
    EXPECT_EQ(score.seen_later, 106u);
    EXPECT_EQ(score.map.found, 106u);
    EXPECT_EQ(score.map.lines, 106u);
    EXPECT_EQ(score.map.right, 106u);
    EXPECT_EQ(score.map.lateral_errors_m.count(), 106u);
    EXPECT_NEAR(score.map.lateral_errors_m.quantile(1.0), 0.0, 1e-9);
  }
  EXPECT_EQ(meter.score(MarkingType::roadedge, k12m).seen_later, 0u);
}

TEST(Later, ErrorsAreTheOffsetsFromWhatIsSeenLater) {
  StraightDrive drive;
  drive.single_error = off_afar;
  drive.map_error = [](double ahead_m) { return ahead_m > 15.0 ? -0.1 : 0.0; };
  const evaluation::LaterMeter meter = drive.rate();
  EXPECT_NEAR(lanelines(meter, k12m).single.lateral_errors_m.root_mean_square(), 0.2, 1e-9);
  EXPECT_NEAR(lanelines(meter, k12m).map.lateral_errors_m.root_mean_square(), 0.0, 1e-9);
  EXPECT_NEAR(lanelines(meter, k20m).single.lateral_errors_m.root_mean_square(), 0.2, 1e-9);
  EXPECT_NEAR(lanelines(meter, k20m).map.lateral_errors_m.root_mean_square(), 0.1, 1e-9);
}

TEST(Later, AMissingLineIsNoPairAndLowersRecall) {
  StraightDrive drive;
  drive.map = {kLeft_m};
  const evaluation::LaterMeter meter = drive.rate();
  const evaluation::LaterScore& score = lanelines(meter, k20m);
  EXPECT_EQ(score.map.found, score.seen_later / 2);
  EXPECT_EQ(score.single.found, score.seen_later);
  EXPECT_EQ(score.map.right, score.map.lines);
  EXPECT_EQ(score.single.lateral_errors_m.count(), score.seen_later / 2);
  EXPECT_EQ(score.map.lateral_errors_m.count(), score.seen_later / 2);
}

TEST(Later, AGhostLowersPrecision) {
  StraightDrive drive;
  drive.map.push_back(0.5);
  const evaluation::LaterScore score = lanelines(drive.rate(), k20m);
  EXPECT_EQ(score.map.lines, 3 * 53u);
  EXPECT_EQ(score.map.right, 2 * 53u);
  EXPECT_EQ(score.single.right, score.single.lines);
}

TEST(Later, WhereNothingIsSeenFromCloseByNoLineIsWrong) {
  StraightDrive drive;
  drive.map.push_back(kLeft_m + 3.5);
  const evaluation::LaterScore score = lanelines(drive.rate(), k20m);
  EXPECT_EQ(score.map.lines, 2 * 53u);
}

TEST(Later, PlacesThatFewFramesPassOverAreNotAsked) {
  StraightDrive drive;
  drive.step_m = 9.0;  // 12 m ahead is 3 m ahead next time; 28 m ahead is 10 m ahead two frames later
  const evaluation::LaterMeter meter = drive.rate();
  EXPECT_EQ(lanelines(meter, k12m).map.lines, 0u);
  EXPECT_GT(lanelines(meter, k28m).map.lines, 100u);
  EXPECT_EQ(lanelines(meter, k28m).map.right, lanelines(meter, k28m).map.lines);
}

TEST(Later, CountsTheOwnLanesIds) {
  StraightDrive drive;
  drive.own_lane = [](int frame) { return frame < 40 ? 1 : frame < 50 ? kNoElement : frame < 60 ? 1 : 2; };
  const evaluation::LaterMeter meter = drive.rate();
  EXPECT_EQ(meter.own_lane().frames, 43u);
  EXPECT_EQ(meter.own_lane().id_changes, 1u);
  EXPECT_NEAR(meter.own_lane().widths_m.quantile(0.05), 3.5, 1e-9);
  EXPECT_NEAR(meter.own_lane().widths_m.quantile(0.95), 3.5, 1e-9);
}

TEST(Later, ATooShortDriveTellsNothing) {
  StraightDrive drive;
  drive.frames = 48;
  EXPECT_EQ(drive.rate().frames(), 0u);
  drive.frames = 49;
  EXPECT_EQ(drive.rate().frames(), 1u);
}

TEST(Later, WhoSeesNothingFromCloseByCannotBeRated) {
  StraightDrive drive;
  EXPECT_TRUE(drive.rate().any());
  drive.single = {};
  EXPECT_FALSE(drive.rate().any());
}

/// The vehicle drives a circle to the left, a metre a frame, 1.75 m from the line on its left.
TEST(Later, PlacesAheadAreAlongTheWayThatWasDriven) {
  constexpr double kRadius_m = 30.0;
  const auto on_circle = [](double angle, double radius_m) {
    return Point(radius_m * std::sin(angle), kRadius_m - radius_m * std::cos(angle), 0.0);
  };
  evaluation::LaterMeter meter(0.3);
  for (int i = 0; i < 100; ++i) {
    const double angle = i / kRadius_m;
    const Eigen::Isometry3d T_map_body = Eigen::Translation3d(on_circle(angle, kRadius_m)) *
                                         Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ());
    Marking line;
    for (int k = 0; k <= 40; ++k) line.points.push_back(on_circle(angle + k / kRadius_m, kRadius_m - 1.75));
    DetectionFrame frame{.stamp_ns = i * kStep_ns, .detections = {{.confidence = 0.9}}};
    for (const Point& point : line.points) frame.detections[0].points.push_back(T_map_body.inverse() * point);
    LocalMap map;
    map.boundaries = {line};
    meter.add(frame, T_map_body, map);
  }
  for (const std::size_t distance : {k12m, k20m, k28m}) {
    const evaluation::LaterScore& score = lanelines(meter, distance);
    EXPECT_GT(score.seen_later, 45u);
    EXPECT_EQ(score.map.found, score.seen_later);
    EXPECT_LT(score.map.lateral_errors_m.quantile(1.0), 0.05);
  }
}

TEST(Later, AJumpOfThePoseBeginsANewDrive) {
  evaluation::LaterMeter meter(0.3);
  Eigen::Isometry3d T_map_body = Eigen::Isometry3d::Identity();
  for (int i = 0; i < 80; ++i) {
    T_map_body.translation().x() += i == 40 ? 100.0 : 1.0;
    meter.add({.stamp_ns = i * kStep_ns}, T_map_body, {});
  }
  EXPECT_EQ(meter.frames(), 0u);  // 40 m each: less than 2 s and 28 m
}

}  // namespace
}  // namespace laneloom
