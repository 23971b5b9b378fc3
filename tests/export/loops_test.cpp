#include "export/loops.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "drives.hpp"
#include "export/line_archive.hpp"
#include "export/motions.hpp"
#include "laneloom/polyline.hpp"
#include "simulation/odometry.hpp"

namespace laneloom::exports {
namespace {

using testing::SizeIs;

/// A circuit: two straights, and two half circles between them.
constexpr double kHalf_m = 376.0, kLap_m = 2.0 * kHalf_m, kRadius_m = 40.0;
constexpr double kStep_m = 2.0;  // between poses
constexpr double kStraight_m = kHalf_m - kRadius_m * std::numbers::pi;

/// The pose of a vehicle on the circuit, which leads to the left.
Eigen::Isometry3d on_circuit(double s) {
  const double in_lap_m = std::fmod(s, kLap_m), in_half_m = std::fmod(in_lap_m, kHalf_m);
  const double turned = std::max(0.0, in_half_m - kStraight_m) / kRadius_m;
  Eigen::Isometry3d pose =
      Eigen::Translation3d(std::min(in_half_m, kStraight_m) + kRadius_m * std::sin(turned),
                           -kRadius_m * std::cos(turned), 0.0) *
      Eigen::Isometry3d(Eigen::AngleAxisd(turned, Point::UnitZ()));
  if (in_lap_m >= kHalf_m)
    pose = Eigen::Translation3d(kStraight_m, 0.0, 0.0) * Eigen::AngleAxisd(std::numbers::pi, Point::UnitZ()) *
           pose;
  return pose;
}

struct CircuitLine {
  MarkingType type = MarkingType::laneline;
  double left_m = 0.0;
};
const std::vector<CircuitLine> kLines{{.left_m = 1.75},
                                      {.left_m = -1.75},
                                      {.type = MarkingType::roadedge, .left_m = 5.5},
                                      {.type = MarkingType::roadedge, .left_m = -3.0}};

/// A drive along the circuit over `length_m`, whose poses drift by a share of the distance.
DriveLines drive_round(double length_m, double drift) {
  DriveLines drive;
  simulation::Odometry odometry(on_circuit(0.0), drift);
  for (double s = 0.0; s < length_m; s += kStep_m) {
    const Eigen::Isometry3d truth = on_circuit(s);
    drive.poses.push_back(odometry.move_to(truth));
    for (ElementId id = 1; const CircuitLine& line : kLines) {
      Polyline points;
      for (double at = s; at <= s + 4.0; at += 1.0)
        points.push_back(drive.poses.back() * truth.inverse() * on_circuit(at) *
                         Point(0.0, line.left_m, 0.0));
      drive.pieces.push_back(test::piece_of(id++, line.type, points, drive));
    }
  }
  return drive;
}

/// The greatest distance between places of a drive that truly are one, a lap apart.
double apart_m(const DriveLines& drive) {
  const auto lap = static_cast<std::size_t>(kLap_m / kStep_m);
  double most_m = 0.0;
  for (std::size_t i = lap; i < drive.poses.size(); ++i)
    most_m = std::max(most_m, (drive.poses[i].translation() - drive.poses[i - lap].translation()).norm());
  return most_m;
}

std::vector<Marking> markings_of(const DriveLines& drive) {
  LineArchive archive;
  for (const ArchivedPiece& piece : drive.pieces) archive.add(piece);
  return archive.markings();
}

TEST(Loops, OfADriftingDriveAreOneRoad) {
  for (const double drift : {0.002, -0.003}) {
    DriveLines drive = drive_round(2.4 * kLap_m, drift);
    EXPECT_GT(apart_m(drive), 1.5);
    EXPECT_GT(markings_of(drive).size(), 4U);
    move(close_loops(drive), drive);
    EXPECT_LT(apart_m(drive), 0.5) << "along a straight, its lines tell no place";
    EXPECT_THAT(markings_of(drive), SizeIs(4)) << "no line is there twice";
    EXPECT_LT(drive.poses.front().translation().norm() - kRadius_m, 1e-3) << "the first pose stays";
  }
}

/// How far the closing of its loops moves a drive, at most.
double bent_by_m(const DriveLines& drive) {
  DriveLines closed = drive;
  move(close_loops(drive), closed);
  double most_m = 0.0;
  for (std::size_t i = 0; i < drive.poses.size(); ++i)
    most_m = std::max(most_m, (closed.poses[i].translation() - drive.poses[i].translation()).norm());
  return most_m;
}

TEST(Loops, OfExactPosesBendNothing) { EXPECT_LT(bent_by_m(drive_round(1.5 * kLap_m, 0.0)), 0.03); }

TEST(Loops, ThatNeverCloseBendNothing) {
  for (const double length_m : {0.0, 2.0, 0.4 * kLap_m, 0.9 * kLap_m})
    EXPECT_LT(bent_by_m(drive_round(length_m, 0.01)), 1e-9) << length_m;
}

TEST(Loops, OnADeckAboveAreAnotherRoad) {
  DriveLines drive = drive_round(1.5 * kLap_m, 0.0);
  std::vector<Eigen::Isometry3d> climbing;
  for (std::size_t i = 0; i < drive.poses.size(); ++i)
    climbing.emplace_back(Eigen::Translation3d(0.0, 0.0, 0.01 * kStep_m * static_cast<double>(i)));
  move(climbing, drive);
  EXPECT_LT(bent_by_m(drive), 1e-9);
}

}  // namespace
}  // namespace laneloom::exports
