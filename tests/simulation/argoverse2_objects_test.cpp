#include "simulation/argoverse2_objects.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <numbers>

#include "io/feather_writer.hpp"
#include "laneloom/polyline.hpp"
#include "simulation/argoverse2.hpp"
#include "simulation/recorded_traffic.hpp"
#include "temporary_folder.hpp"
#include "thrown_by.hpp"

namespace laneloom::simulation {
namespace {

constexpr std::int64_t kBegin_ns = 7'000'000'000;
constexpr std::int64_t kSweep_ns = 100'000'000;

/// A log of a second, in which the vehicle drives along x at 10 m/s.
class AnnotatedLog : public testing::Test {
 protected:
  void SetUp() override {
    write_bytes(folder_.file("city_SE3_egovehicle.feather"),
                FeatherWriter(pose_columns(kBegin_ns, 11)).write());
  }
  void annotate(const FeatherWriter::Columns& columns) const {
    write_bytes(folder_.file("annotations.feather"), FeatherWriter(columns).write());
  }
  static AnnotationRow row(int sweep, const std::string& track, double x, double y = 0.0,
                           const std::string& category = "REGULAR_VEHICLE") {
    return {kBegin_ns + sweep * kSweep_ns, track, category, x, y};
  }
  std::vector<TrackedObjects> objects(bool strict = true) {
    left_out_ = LeftOut(strict);
    return argoverse2_objects(folder_.path(), argoverse2_poses(folder_.path(), left_out_), left_out_);
  }
  std::string error() {
    return thrown_by<std::exception>([&] { objects(); });
  }

  LeftOut left_out_;

 private:
  const TemporaryFolder folder_;
};

TEST_F(AnnotatedLog, ObjectsComeBySweepInTheBodyFrame) {
  AnnotationRow oncoming = row(1, "b", 20.0, 3.0, "BUS");
  oncoming.yaw_rad = std::numbers::pi;
  annotate(annotation_columns({oncoming, row(0, "a", 15.0), row(1, "a", 15.0)}));
  const auto sweeps = objects();
  ASSERT_EQ(sweeps.size(), 2U);
  EXPECT_EQ(sweeps[1].stamp_ns, kBegin_ns + kSweep_ns);
  EXPECT_FALSE(sweeps[1].in_map_frame);
  ASSERT_EQ(sweeps[1].objects.size(), 2U);
  const TrackedObject &car = sweeps[1].objects[0], &bus = sweeps[1].objects[1];
  EXPECT_EQ(car.id, sweeps[0].objects.at(0).id);
  EXPECT_NE(car.id, bus.id);
  EXPECT_EQ(car.kind, ObjectKind::car);
  EXPECT_EQ(bus.kind, ObjectKind::bus);
  EXPECT_TRUE(bus.position.isApprox(Point(20.0, 3.0, 0.0), 1e-9)) << "on the ground";
  EXPECT_TRUE(bus.heading.isApprox(-Point::UnitX(), 1e-9));
  EXPECT_EQ(bus.length_m, 4.0);
  EXPECT_EQ(bus.width_m, 2.0);
}

TEST_F(AnnotatedLog, SpeedsAreOverGroundAndAlongTheHeading) {
  std::vector<AnnotationRow> rows;
  for (const int sweep : {0, 1, 2, 3, 7}) {
    rows.push_back(row(sweep, "follows", 15.0));                // as fast as the vehicle
    rows.push_back(row(sweep, "stands", 15.0 - sweep));         // in the map frame
    rows.push_back(row(sweep, "oncomes", 60.0 - 1.5 * sweep));  // 5 m/s
    rows.back().yaw_rad = std::numbers::pi;
  }
  annotate(annotation_columns(rows));
  const auto sweeps = objects();
  ASSERT_EQ(sweeps.size(), 5U);
  const std::map<std::uint64_t, double> speeds_mps{{1, 10.0}, {2, 0.0}, {3, 5.0}};  // in the order above
  for (std::size_t i = 0; i < 4; ++i)
    for (const TrackedObject& object : sweeps[i].objects)
      EXPECT_NEAR(object.speed_mps, speeds_mps.at(object.id), 1e-6) << i;
  for (const TrackedObject& object : sweeps[4].objects) EXPECT_EQ(object.speed_mps, 0.0) << "of one sweep";
}

TEST_F(AnnotatedLog, WhatIsNoTrafficIsNotThere) {
  annotate(annotation_columns({row(0, "a", 1.0), row(0, "b", 2.0, 0.0, "STOP_SIGN"),
                               row(0, "c", 0.0, 0.0, "EGO_VEHICLE"), row(0, "d", 3.0, 0.0, "PEDESTRIAN")}));
  const auto sweeps = objects();
  ASSERT_EQ(sweeps.size(), 1U);
  ASSERT_EQ(sweeps[0].objects.size(), 2U);
  EXPECT_EQ(sweeps[0].objects[1].kind, ObjectKind::pedestrian);
}

TEST_F(AnnotatedLog, OfManyObjectsTheNearestAreTaken) {
  std::vector<AnnotationRow> rows;
  for (int i = 300; i > 0; --i) rows.push_back(row(0, std::to_string(i), i));
  annotate(annotation_columns(rows));
  const auto sweeps = objects();
  ASSERT_EQ(sweeps.at(0).objects.size(), 256U);
  EXPECT_EQ(sweeps[0].objects.back().position.x(), 256.0);
}

TEST_F(AnnotatedLog, ALogMayHaveNoAnnotations) { EXPECT_TRUE(objects().empty()); }

TEST_F(AnnotatedLog, RowsThatAreWrongAreLeftOut) {
  const auto complaint = [&](const FeatherWriter::Columns& columns) {
    annotate(columns);
    EXPECT_EQ(objects(/*strict=*/false).at(0).objects.size(), 1U);
    EXPECT_EQ(left_out_.summary().substr(0, 2), "1 ");
    return error();
  };
  const auto has = [](const std::string& text, const char* part) {
    return text.find("annotations.feather: row 1: " + std::string(part)) != std::string::npos;
  };
  AnnotationRow wrong = row(0, "b", 2.0);
  wrong.length_m = -1.0;
  std::string said = complaint(annotation_columns({row(0, "a", 1.0), wrong}));
  EXPECT_TRUE(has(said, "a size of 0 or more")) << said;
  said =
      complaint(annotation_columns({row(0, "a", 1.0), row(0, "b", std::numeric_limits<double>::infinity())}));
  EXPECT_TRUE(has(said, "a finite number")) << said;
  said = complaint(annotation_columns({row(0, "a", 1.0), row(0, "a", 2.0)}));
  EXPECT_TRUE(has(said, "a track comes twice in a sweep")) << said;
  for (const int sweep : {-1, 11}) {
    said = complaint(annotation_columns({row(0, "a", 1.0), row(sweep, "b", 2.0)}));
    EXPECT_TRUE(has(said, "a stamp between those of the poses")) << said;
  }
  auto columns = annotation_columns({row(0, "a", 1.0), row(0, "b", 2.0)});
  std::get<std::vector<double>>(columns[6].second)[1] = 2.0;
  said = complaint(columns);
  EXPECT_TRUE(has(said, "a quaternion of unit length")) << said;
  columns.pop_back();
  columns.erase(columns.begin() + 1);
  annotate(columns);
  EXPECT_NE(error().find("annotations.feather: has no column track_uuid"), std::string::npos) << error();
}

TEST_F(AnnotatedLog, ObjectsMoveOnBetweenTheSweeps) {
  std::vector<AnnotationRow> rows;
  for (const int sweep : {2, 3}) rows.push_back(row(sweep, "a", 15.0 + sweep, 1.0));  // 20 m/s
  annotate(annotation_columns(rows));
  std::vector<VehiclePose> poses(11);
  for (std::size_t i = 0; i < poses.size(); ++i)
    poses[i] = {.stamp_ns = kBegin_ns + static_cast<std::int64_t>(i) * kSweep_ns,
                .position = {static_cast<double>(i), 0.0, 0.0}};
  const Drive drive = Drive::recorded(poses);
  RecordedTraffic traffic(objects(), drive, kBegin_ns);
  const auto at = [&](double drive_s) {
    VehiclePose pose = drive.pose_at(drive_s);
    pose.stamp_ns = 5;
    return traffic.observe(pose, drive_s);
  };
  EXPECT_TRUE(at(0.19).objects.empty()) << "before the first sweep";
  const TrackedObjects seen = at(0.36);
  EXPECT_EQ(seen.stamp_ns, 5);
  EXPECT_FALSE(seen.in_map_frame);
  ASSERT_EQ(seen.objects.size(), 1U);
  EXPECT_NEAR(seen.objects[0].speed_mps, 20.0, 1e-6);
  EXPECT_TRUE(seen.objects[0].position.isApprox(Point(18.6, 1.0, 0.0), 1e-6)) << seen.objects[0].position;
  EXPECT_TRUE(at(0.46).objects.empty()) << "long after the last one";
}

// The moving cars of real logs drive in the lanes of the map, some of which are wide, and in their direction.
TEST(RealAnnotations, CarsDriveAlongLanes) {
  const std::filesystem::path data = std::filesystem::path(LANELOOM_DATA) / "argoverse2";
  if (!std::filesystem::is_directory(data)) GTEST_SKIP() << "no Argoverse 2 logs in " << data;
  for (const auto& log : std::filesystem::directory_iterator(data)) {
    LeftOut nothing(/*strict=*/true);
    const auto poses = argoverse2_poses(log.path(), nothing);
    const auto sweeps = argoverse2_objects(log.path(), poses, nothing);
    const Road road = load_argoverse2(log.path());
    SCOPED_TRACE(road.name);
    ASSERT_GT(sweeps.size(), 100U);
    std::vector<MeasuredPolyline> lines;
    for (const RoadLane& lane : road.lanes) lines.emplace_back(lane.centerline);
    int moving = 0, along = 0;
    for (const TrackedObjects& sweep : sweeps) {
      const double drive_s = static_cast<double>(sweep.stamp_ns - poses.front().stamp_ns) * 1e-9;
      const Eigen::Isometry3d T_map_body = transform(road.drive.pose_at(drive_s));
      for (const TrackedObject& object : sweep.objects) {
        EXPECT_LT(std::abs(object.speed_mps), 30.0);
        if (object.kind != ObjectKind::car || object.speed_mps < 3.0 || object.position.norm() > 40.0)
          continue;
        ++moving;
        const Point position = T_map_body * object.position, heading = T_map_body.linear() * object.heading;
        along +=
            std::ranges::any_of(lines,
                                [&](const MeasuredPolyline& line) {
                                  const Projection foot = line.project(position, 2.5);
                                  return foot.inside && line.direction(foot).dot(heading.head<2>()) > 0.8;
                                })
                ? 1
                : 0;
      }
    }
    EXPECT_GT(moving, 100);
    EXPECT_GT(along, 0.9 * moving) << moving;
  }
}

}  // namespace
}  // namespace laneloom::simulation
