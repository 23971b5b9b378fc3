#include "check/findings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <ostream>

#include "base/degree.hpp"
#include "check/drives.hpp"

namespace laneloom::check {
namespace {

constexpr const char* kMeasured = "the value is measured";

std::vector<DetectionFrame>& frames_of(Drive& drive) { return drive.frames.begin()->second; }

using ChangePoint = std::function<Point(const Point& point, const Eigen::Isometry3d& T_map_body)>;

/// Changes all points, in the way of a writer who has other conventions.
std::function<void(Drive&)> points(const ChangePoint& change) {
  return [change](Drive& drive) {
    auto pose = drive.poses.begin();
    for (DetectionFrame& frame : frames_of(drive)) {
      const Eigen::Isometry3d T_map_body = transform(*pose++);
      for (Detection& detection : frame.detections)
        for (Point& point : detection.points) point = change(point, T_map_body);
    }
  };
}

std::function<void(Drive&)> poses(const std::function<void(VehiclePose&)>& change) {
  return [change](Drive& drive) { std::ranges::for_each(drive.poses, change); };
}

std::function<void(Drive&)> confidences(const std::function<double(double)>& change) {
  return [change](Drive& drive) {
    for (DetectionFrame& frame : frames_of(drive))
      for (Detection& detection : frame.detections) detection.confidence = change(detection.confidence);
  };
}

/// A drive whose poses have the stamps of others, so many frames away.
void shift_poses(Drive& drive, int frames) {
  const std::vector<VehiclePose> right = drive.poses;
  std::vector<VehiclePose>& poses = drive.poses;
  const auto size = static_cast<int>(right.size());
  for (int i = 0; i < size; ++i) {
    const int from = std::clamp(i + frames, 0, size - 1);
    poses[static_cast<std::size_t>(i)].position = right[static_cast<std::size_t>(from)].position;
    poses[static_cast<std::size_t>(i)].orientation = right[static_cast<std::size_t>(from)].orientation;
  }
}

void jump(Drive& drive, const Point& shift_m, double turn_deg) {
  const auto half = static_cast<std::ptrdiff_t>(drive.poses.size() / 2);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(turn_deg * kDegree, Point::UnitZ()));
  for (auto pose = drive.poses.begin() + half; pose != drive.poses.end(); ++pose) {
    pose->position += shift_m;
    pose->orientation = turn * pose->orientation;
  }
}

struct Mistake {
  std::string name;
  std::function<void(Drive&)> make;
  std::string id;      ///< of the first finding
  std::string remedy;  ///< what it says, or a part of it
};

std::ostream& operator<<(std::ostream& out, const Mistake& mistake) { return out << mistake.name; }

Point turned(const Point& point, double angle_deg) {
  return Eigen::AngleAxisd(angle_deg * kDegree, Point::UnitZ()) * point;
}

std::vector<Mistake> mistakes() {
  return {
      {"ScalarFirst", poses([](VehiclePose& pose) {
         const Eigen::Quaterniond q = pose.orientation;
         pose.orientation = Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y());
       }),
       "quaternion_order", "--quaternion wxyz"},
      {"Mirrored", points([](const Point& p, const auto&) { return Point(p.x(), -p.y(), p.z()); }), "axes",
       "--axes forward-right"},
      {"RightForward", points([](const Point& p, const auto&) { return Point(-p.y(), p.x(), p.z()); }),
       "axes", "--axes right-forward"},
      {"Swapped", points([](const Point& p, const auto&) { return Point(p.y(), p.x(), p.z()); }), "axes",
       "--axes left-forward"},
      {"CameraAxes", points([](const Point& p, const auto&) { return Point(-p.y(), 1.5 - p.z(), p.x()); }),
       "axes", "--axes right-down-forward"},
      {"Backward", points([](const Point& p, const auto&) { return Point(-p.x(), -p.y(), p.z()); }), "axes",
       "--axes backward-right"},
      {"InTheMapFrame",
       points([](const Point& p, const Eigen::Isometry3d& T_map_body) -> Point { return T_map_body * p; }),
       "points_in_map_frame", "--points-in-map"},
      {"Millimetres", points([](const Point& p, const auto&) -> Point { return 1000.0 * p; }), "point_unit",
       "--point-scale 0.001"},
      {"Centimetres", points([](const Point& p, const auto&) -> Point { return 100.0 * p; }), "point_unit",
       "--point-scale 0.01"},
      {"Kilometres", points([](const Point& p, const auto&) -> Point { return p / 1000.0; }), "point_unit",
       "--point-scale 1000"},
      {"SharesOfTheRange", points([](const Point& p, const auto&) {
         return Point(p.x() / 120.0 + 0.5, p.y() / 60.0 + 0.5, 0.0);
       }),
       "points", "metres"},
      {"PosesInMillimetres", poses([](VehiclePose& pose) { pose.position *= 1000.0; }), "pose_unit",
       "--pose-scale 0.001"},
      {"PosesInCentimetres", poses([](VehiclePose& pose) { pose.position *= 100.0; }), "pose_unit",
       "--pose-scale 0.01"},
      {"PosesLate", [](Drive& drive) { shift_poses(drive, -3); }, "pose_time", kMeasured},
      {"PosesEarly", [](Drive& drive) { shift_poses(drive, 3); }, "pose_time", kMeasured},
      {"SensorTurned", points([](const Point& p, const auto&) { return turned(p, 2.0); }), "sensor_yaw",
       kMeasured},
      {"SensorBeside", points([](const Point& p, const auto&) { return Point(p.x(), p.y() - 0.6, p.z()); }),
       "sensor_left", kMeasured},
      {"Percent", confidences([](double share) { return 100.0 * share; }), "confidence_scale",
       "--confidence percent"},
      {"LogOdds", confidences([](double share) {
         const double inside = std::clamp(share, 0.01, 0.99);
         return std::log(inside / (1.0 - inside));
       }),
       "confidence_scale", "--confidence logit"},
      {"LowConfidences", confidences([](double share) { return 0.05 * share; }), "confidence_low",
       "mapper.preprocess.min_confidence"},
      {"NarrowLane", points([](const Point& p, const auto&) { return Point(p.x(), 0.45 * p.y(), p.z()); }),
       "lane_narrow", "mapper.lane.min_width_m"},
      {"SmallJump",
       [](Drive& drive) {
         jump(drive, {0.2, 0.6, 0.0}, 0.0);
       },
       "pose_jump", "session_id"},
      {"TurnedJump", [](Drive& drive) { jump(drive, Point::Zero(), 4.0); }, "pose_jump", "session_id"},
      {"FramesOutOfOrder",
       [](Drive& drive) {
         for (std::size_t i = 10; i + 1 < drive.poses.size(); i += 7)
           std::swap(frames_of(drive)[i], frames_of(drive)[i + 1]);
       },
       "frames_out_of_order", "laneloom import frames"},
      {"PosesOutOfOrder",
       [](Drive& drive) {
         for (std::size_t i = 10; i + 1 < drive.poses.size(); i += 7)
           std::swap(drive.poses[i], drive.poses[i + 1]);
       },
       "poses_out_of_order", "laneloom import frames"},
      {"FramesMissing",
       [](Drive& drive) {
         frames_of(drive).erase(frames_of(drive).begin() + 50, frames_of(drive).begin() + 80);
       },
       "frames_gap", "service.stale_after_s"},
      {"PosesMissing",
       [](Drive& drive) { drive.poses.erase(drive.poses.begin() + 50, drive.poses.begin() + 80); },
       "poses_gap", "service.stale_after_s"},
      {"PosesRare",
       [](Drive& drive) {
         std::size_t i = 0;
         std::erase_if(drive.poses, [&](const VehiclePose&) { return i++ % 4 != 0; });
       },
       "poses_rare", "sync.max_pose_gap_s"},
      {"FramesRare",
       [](Drive& drive) {
         std::size_t i = 0;
         std::erase_if(frames_of(drive), [&](const DetectionFrame&) { return i++ % 8 != 0; });
       },
       "frames_rare", "service.stale_after_s"},
      {"StampsInMilliseconds",
       [](Drive& drive) {
         for (DetectionFrame& frame : frames_of(drive)) frame.stamp_ns *= 1000;
         for (VehiclePose& pose : drive.poses) pose.stamp_ns *= 1000;
       },
       "stamps_not_seconds", "milliseconds"},
      {"NoPoses", [](Drive& drive) { drive.poses.clear(); }, "no_poses", "laneloom doctor"},
      {"NoDetections", [](Drive& drive) { drive.frames.clear(); }, "no_detections", "laneloom doctor"},
  };
}

/// The findings that are no advice.
Findings wrong(const Drive& drive) {
  Findings found = findings(drive, Config{});
  std::erase_if(found, &Finding::advice);
  return found;
}

class Mistakes : public testing::TestWithParam<Mistake> {};

TEST_P(Mistakes, IsNamedFirst) {
  const std::pair<const char*, const char*> kDrives[] = {
      {"town", "inhouse"}, {"country_road", "random:3"}, {"curve", "none"}};
  for (const auto& [scenario, noise] : kDrives) {
    SCOPED_TRACE(scenario);
    Drive drive = simulated_drive(scenario, noise);
    GetParam().make(drive);
    const Findings found = wrong(drive);
    ASSERT_FALSE(found.empty());
    EXPECT_EQ(found.front().id, GetParam().id) << found.front().found;
    if (GetParam().remedy == kMeasured) continue;
    EXPECT_THAT(found.front().remedy, testing::HasSubstr(GetParam().remedy));
  }
}

INSTANTIATE_TEST_SUITE_P(All, Mistakes, testing::ValuesIn(mistakes()),
                         [](const auto& test) { return test.param.name; });

class SoundDrives : public testing::TestWithParam<std::string> {};

TEST_P(SoundDrives, HaveNoFindings) {
  for (const char* noise : {"none", "inhouse", "random:2", "random:5"})
    EXPECT_THAT(wrong(simulated_drive(GetParam(), noise)), testing::IsEmpty()) << noise;
}

INSTANTIATE_TEST_SUITE_P(Roads, SoundDrives,
                         testing::Values("straight", "curve", "street", "country_road", "motorway", "exit",
                                         "hill", "t_intersection", "overpass", "town"),
                         [](const auto& test) { return test.param; });

/// A drive along lines that bend, of steady speed, whose points lie on a grid, as many writers' do.
Drive drive_on_a_grid(double bend, double speed_mps, double left_m, double right_m) {
  constexpr int kFrames = 150;
  Drive drive;
  for (int i = 0; i < kFrames; ++i) {
    const double x_m = 0.1 * speed_mps * i, heading = std::atan(bend * x_m);
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(heading, Point::UnitZ()));
    const std::int64_t stamp_ns = 100'000'000LL * (i + 1);
    drive.poses.push_back(
        {.stamp_ns = stamp_ns, .position = {x_m, 0.5 * bend * x_m * x_m, 0.0}, .orientation = turn});
    DetectionFrame& frame = drive.frames[""].emplace_back();
    frame.stamp_ns = stamp_ns;
    for (const double lateral_m : {left_m, right_m}) {
      Detection& line = frame.detections.emplace_back(Detection{.confidence = 0.8, .points = {}});
      for (double ahead_m = 0.0; ahead_m <= 40.0; ahead_m += 4.0)
        line.points.emplace_back(ahead_m, lateral_m + 0.5 * bend * ahead_m * ahead_m, 0.0);
    }
  }
  return drive;
}

TEST(Findings, PointsOnAGridAreNoMistake) {
  for (const double bend : {0.0, 0.0001, 0.0005})
    for (const double speed_mps : {5.0, 10.0, 15.0, 20.0})
      EXPECT_THAT(wrong(drive_on_a_grid(bend, speed_mps, 1.75, -1.75)), testing::IsEmpty())
          << bend << " " << speed_mps;
}

TEST(Findings, ALaneIsWideWhereNoneIsFound) {
  EXPECT_THAT(wrong(drive_on_a_grid(0.0, 10.0, 2.6, -2.6)), testing::IsEmpty());
  const Findings found = wrong(drive_on_a_grid(0.0, 10.0, 3.5, -3.5));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].id, "lane_wide");
}

TEST(Findings, ALineThatTheNetworkDoubtsNarrowsNoLane) {
  Drive drive = drive_on_a_grid(0.0, 10.0, 1.75, -1.75);
  for (DetectionFrame& frame : frames_of(drive)) {
    Detection doubted = frame.detections.back();
    for (Point& point : doubted.points) point.y() = 0.2;
    frame.detections.push_back(doubted);
  }
  ASSERT_EQ(wrong(drive).size(), 1u) << "a lane of 1.55 m";
  for (DetectionFrame& frame : frames_of(drive)) frame.detections.back().confidence = 0.04;
  EXPECT_THAT(wrong(drive), testing::IsEmpty());
}

TEST(Findings, DetectionsOfOtherFramesDoNotFitTogether) {
  Drive drive = simulated_drive("town", "inhouse");
  auto& frames = frames_of(drive);
  for (std::size_t i = 0; i < frames.size(); ++i)
    std::swap(frames[i].detections, frames[(i * 7919) % frames.size()].detections);
  const Findings found = findings(drive, {});
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].id, "disagreement") << found[0].found;
}

TEST(Findings, TwoRunsInOneFileAreTwoDrives) {
  Drive drive = simulated_drive("straight", "none");
  const std::size_t poses = drive.poses.size();
  std::vector<VehiclePose> again = drive.poses;
  for (VehiclePose& pose : again) pose.position.x() += 5000.0;
  drive.poses.insert(drive.poses.end(), again.begin(), again.end());
  const Findings found = findings(drive, {});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].id, "several_runs");
  EXPECT_NE(found[0].found.find("2 runs"), std::string::npos);
  EXPECT_NE(found[0].found.find("pose " + std::to_string(poses + 1)), std::string::npos);
  std::swap(drive.poses[3], drive.poses[40]);
  EXPECT_TRUE(later_runs(drive.poses).empty()) << "it is out of order, too";
}

TEST(Findings, PosesMayJumpWhereANewSessionBegins) {
  Drive drive = simulated_drive("town", "none");
  const auto second = drive.poses.begin() + 200;
  std::for_each(second, drive.poses.end(), [](VehiclePose& pose) { pose.position.x() += 100.0; });
  EXPECT_EQ(jump_findings(PoseTrack(drive.poses), {}).size(), 1u);
  std::for_each(second, drive.poses.end(), [](VehiclePose& pose) { pose.session_id = 2; });
  EXPECT_THAT(jump_findings(PoseTrack(drive.poses), {}), testing::IsEmpty());
}

TEST(Findings, AStraightRoadCannotTellItsMirrorImage) {
  const Findings found = findings(simulated_drive("straight", "none"), Config{});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].id, "few_turns");
  EXPECT_TRUE(found[0].advice);
}

TEST(Findings, ObjectsThatAreOfNoUse) {
  const TrackedObject car{
      .id = 7, .kind = ObjectKind::car, .position = {20, 3, 0}, .heading = {1, 0, 0}, .speed_mps = 9.0};
  const auto found = [](std::vector<TrackedObject> objects) {
    const TrackedObjects message{.stamp_ns = 1'000'000'000, .objects = std::move(objects)};
    return object_findings({message, message}, {});
  };
  EXPECT_THAT(found({car}), testing::IsEmpty());
  const Findings doubles = found({car, car});
  ASSERT_EQ(doubles.size(), 1u);
  EXPECT_EQ(doubles[0].found, "2 of 2 messages of objects are refused as 'repeated_id'.");
  EXPECT_FALSE(doubles[0].advice);

  TrackedObject headless = car, vague = car, standing = car, cyclist = car;
  headless.id = 8;
  headless.heading.setZero();
  vague.id = 9;
  vague.position_stddev_m = 1.5;
  const Findings useless = found({headless, vague});
  ASSERT_EQ(useless.size(), 1u);
  EXPECT_EQ(useless[0].id, "objects_leave_no_trail");
  EXPECT_THAT(useless[0].found, testing::HasSubstr("Of 4 moving objects, 2 have no heading, and 2 are"));
  EXPECT_THAT(found({headless, vague, car}), testing::IsEmpty()) << "one tells something";
  standing.heading.setZero();
  standing.speed_mps = 0.5;
  EXPECT_THAT(found({standing}), testing::IsEmpty()) << "it would leave none anyway";
  cyclist.kind = ObjectKind::bicycle;
  cyclist.position_stddev_m = 1.5;
  EXPECT_THAT(found({cyclist}), testing::IsEmpty());
}

TEST(Findings, AskTheObjectsToo) {
  Drive drive = simulated_drive("town", "none");
  drive.objects = {{.stamp_ns = 1'000'000'000, .objects = {{.id = 7, .heading = {2, 0, 0}}}}};
  const Findings found = wrong(drive);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].id, "objects_refused");
}

TEST(Findings, OfSeveralSourcesTheOneAtFaultIsNamed) {
  Drive drive = simulated_drive("town", "none");
  drive.frames["camera"] = drive.frames.at("");
  drive.frames.erase("");
  points([](const Point& p, const auto&) { return Point(p.x(), -p.y(), p.z()); })(drive);
  drive.frames["lidar"] = simulated_drive("town", "none").frames.at("");
  const Findings found = wrong(drive);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].id, "axes");
  EXPECT_THAT(found[0].found, testing::StartsWith("\"camera\": "));
}

TEST(Findings, ValuesAreMeasured) {
  for (const int frames : {-4, 2}) {
    Drive drive = simulated_drive("town", "inhouse");
    shift_poses(drive, frames);
    Correction correction;
    convention_findings(frames_of(drive), PoseTrack(drive.poses), correction);
    EXPECT_NEAR(correction.pose_time_s, 0.1 * frames, 0.04);
  }
  for (const double yaw_deg : {-3.0, 1.5}) {
    Drive drive = simulated_drive("country_road", "inhouse");
    points([&](const Point& p, const auto&) { return turned(p, yaw_deg); })(drive);
    Correction correction;
    convention_findings(frames_of(drive), PoseTrack(drive.poses), correction);
    EXPECT_NEAR(correction.sensor_yaw_deg, -yaw_deg, 0.3);
  }
}

}  // namespace
}  // namespace laneloom::check
