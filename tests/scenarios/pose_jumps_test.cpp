#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/degree.hpp"
#include "laneloom/mapper.hpp"
#include "laneloom/polyline.hpp"
#include "simulation/perception.hpp"
#include "simulation/scenarios.hpp"

/// Poses that jump by less than the gate refuses. The map is to move with them: seen from the vehicle, it is
/// the map that there would be without the jump.
namespace laneloom {
namespace {

constexpr double kFrame_s = 0.1;
constexpr std::size_t kFramesAfter = 20, kFramesToMove = 3;
constexpr double kMaxApart_m = 0.35;       // mean, of the lines of the two maps
constexpr std::size_t kMostLinesMore = 2;  // a second road has four or more

struct Jump {
  double ahead_m = 0.0, left_m = 0.0, turn_deg = 0.0;  ///< of the pose, in the body frame

  Eigen::Isometry3d motion() const {
    return Eigen::Translation3d(ahead_m, left_m, 0.0) *
           Eigen::AngleAxisd(turn_deg * kDegree, Eigen::Vector3d::UnitZ());
  }
};

std::vector<Jump> jumps_of(double sign) {
  std::vector<Jump> jumps;
  for (const double step_m : {0.3, 0.6, 1.0, 1.75, 2.5, 3.5, 5.0}) {
    jumps.push_back({.ahead_m = sign * step_m});
    jumps.push_back({.left_m = sign * step_m});
  }
  for (const double turn_deg : {1.0, 2.0, 4.0, 7.0, 10.0}) jumps.push_back({.turn_deg = sign * turn_deg});
  jumps.push_back({.ahead_m = 2.0, .left_m = sign * 2.0, .turn_deg = sign * 5.0});
  return jumps;
}

void PrintTo(const Jump& jump, std::ostream* out) {
  *out << jump.ahead_m << " m ahead, " << jump.left_m << " m to the left, " << jump.turn_deg << " degrees";
}

/// The frames of a drive, and the poses that they are seen from.
struct Frames {
  Frames(const std::string& scenario, const std::string& noise, double duration_s, std::uint64_t seed = 1,
         double frame_s = kFrame_s) {
    const simulation::Road road = simulation::make_scenario(scenario);
    simulation::Perception perception(road, simulation::noise_profile(noise), simulation::SensorView{}, seed);
    for (double t_s = frame_s; t_s < std::min(duration_s, road.drive.duration_s()); t_s += frame_s) {
      const VehiclePose pose = road.drive.pose_at(t_s);
      frames.push_back(perception.observe(pose));
      poses.push_back(transform(pose));
    }
  }
  std::vector<DetectionFrame> frames;
  std::vector<Eigen::Isometry3d> poses;
};

/// A map, and the pose that it is seen from.
struct Seen {
  LocalMap map;
  Eigen::Isometry3d T_map_body;

  /// The lines ahead, body frame.
  std::vector<Polyline> lines() const {
    std::vector<Polyline> all;
    for (const Marking& marking : map.markings) {
      if (marking.type == MarkingType::stopline) continue;
      Polyline line;
      for (const Point& point : marking.points)
        if (const Point ahead = T_map_body.inverse() * point; ahead.x() > 0.0 && ahead.x() < 25.0)
          line.push_back(ahead);
      if (line.size() >= 2) all.push_back(std::move(line));
    }
    return all;
  }
};

/// The mean distance of the lines of one map from those of another one. Each point counts up to 1 m.
double apart_m(const Seen& seen, const Seen& from) {
  std::vector<MeasuredPolyline> others;
  for (const Polyline& line : from.lines()) others.emplace_back(line);
  double sum_m = 0.0, points = 0.0;
  for (const Polyline& line : seen.lines())
    for (const Point& point : MeasuredPolyline(line).resample(1.0)) {
      double least_m = 1.0;
      for (const MeasuredPolyline& other : others)
        least_m = std::min(least_m, other.project(point).distance_m);
      sum_m += least_m;
      points += 1.0;
    }
  return points > 0.0 && !others.empty() ? sum_m / points : 0.0;
}

struct Road {
  const char* scenario;
  const char* noise;
};
void PrintTo(const Road& road, std::ostream* out) { *out << road.scenario << " " << road.noise; }

class PoseJumps : public ::testing::TestWithParam<Road> {
 protected:
  void SetUp() override {
    Mapper mapper{MapperConfig{}};
    for (std::size_t i = 0; i < drive_.frames.size(); ++i) {
      undisturbed_.push_back({mapper.update(drive_.frames[i], drive_.poses[i]), drive_.poses[i]});
      ASSERT_FALSE(mapper.poses_jumped()) << "frame " << i;
    }
  }
  /// Drives with a jump; returns whether it was found.
  bool drive(const Jump& jump) {
    Mapper mapper{MapperConfig{}};
    const std::size_t at = drive_.frames.size() - kFramesAfter;
    const Eigen::Isometry3d motion = drive_.poses[at] * jump.motion() * drive_.poses[at].inverse();
    bool found = false;
    for (std::size_t i = 0; i < drive_.frames.size(); ++i) {
      const Eigen::Isometry3d pose = i < at ? drive_.poses[i] : motion * drive_.poses[i];
      const Seen seen{mapper.update(drive_.frames[i], pose), pose};
      if (mapper.poses_jumped()) {
        EXPECT_FALSE(std::exchange(found, true)) << "told twice";
        EXPECT_GE(i, at);
      }
      if (i < at + kFramesToMove) continue;
      EXPECT_LT(apart_m(seen, undisturbed_[i]), kMaxApart_m) << i - at << " frames after the jump";
      EXPECT_LE(seen.lines().size(), undisturbed_[i].lines().size() + kMostLinesMore)
          << i - at << " frames after the jump";
    }
    return found;
  }

  Frames drive_{GetParam().scenario, GetParam().noise, 9.0};
  std::vector<Seen> undisturbed_;
};

TEST_P(PoseJumps, MoveTheMap) {
  for (const double sign : {1.0, -1.0}) {
    for (const Jump& jump : jumps_of(sign)) {
      SCOPED_TRACE(::testing::PrintToString(jump));
      const bool found = drive(jump);
      // On a straight road, nothing tells how far ahead the vehicle is, and a map that stays fits as well.
      // The smallest steps are as large as a frame's own error.
      if (std::abs(jump.left_m) > 0.5 || std::abs(jump.turn_deg) > 1.5) {
        EXPECT_TRUE(found);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Roads, PoseJumps,
                         ::testing::Values(Road{"straight", "inhouse"}, Road{"curve", "inhouse"},
                                           Road{"street", "inhouse"}, Road{"town", "av2"},
                                           Road{"country_road", "av2"}, Road{"motorway", "inhouse"}));

/// Two frames a second, as in some recordings. Between two of them a vehicle may turn as far as the poses
/// jump, so that the detections alone tell.
TEST(PoseJumpsBetweenRareFrames, MoveTheMap) {
  for (const char* road : {"straight", "motorway", "street"}) {
    const Frames drive(road, "none", 30.0, 1, 0.5);
    const std::size_t at = drive.frames.size() - kFramesAfter;
    for (const Jump& jump : {Jump{.left_m = 2.0}, Jump{.turn_deg = 2.0}, Jump{.turn_deg = -4.0}}) {
      SCOPED_TRACE(std::string(road) + ", " + ::testing::PrintToString(jump));
      const Eigen::Isometry3d motion = drive.poses[at] * jump.motion() * drive.poses[at].inverse();
      Mapper mapper{MapperConfig{}}, undisturbed{MapperConfig{}};
      for (std::size_t i = 0; i < drive.frames.size(); ++i) {
        const Eigen::Isometry3d pose = i < at ? drive.poses[i] : motion * drive.poses[i];
        const Seen seen{mapper.update(drive.frames[i], pose), pose};
        const Seen usual{undisturbed.update(drive.frames[i], drive.poses[i]), drive.poses[i]};
        EXPECT_EQ(mapper.poses_jumped(), i == at) << "frame " << i;
        EXPECT_EQ(seen.lines().size(), usual.lines().size()) << "frame " << i;
      }
    }
  }
}

/// A camera to the rear, which sees nothing, sends three frames between two of the front camera.
TEST(PoseJumpsBetweenSources, AreDecidedByFramesThatShowLines) {
  const Frames drive("street", "inhouse", 9.0);
  const std::size_t at = drive.frames.size() - kFramesAfter;
  const Eigen::Isometry3d motion = drive.poses[at] * Jump{.left_m = 0.9}.motion() * drive.poses[at].inverse();
  Mapper mapper{MapperConfig{}};
  bool found = false;
  for (std::size_t i = 0; i + 1 < drive.frames.size(); ++i) {
    for (int k = 0; k < 4; ++k) {
      const double share = 0.25 * k;
      Eigen::Isometry3d pose = drive.poses[i];
      pose.translation() += share * (drive.poses[i + 1].translation() - drive.poses[i].translation());
      DetectionFrame frame = drive.frames[i];
      if (k > 0) {
        frame.stamp_ns += static_cast<std::int64_t>(share * kFrame_s * 1e9);
        frame.source = "rear";
        frame.detections.clear();
      }
      // The poses jump right behind a frame of the front camera.
      const bool jumped = i > at || (i == at && k > 0);
      mapper.update(frame, jumped ? motion * pose : pose);
      found = found || mapper.poses_jumped();
    }
  }
  EXPECT_TRUE(found);
}

/// Odometry that is corrected over half a second.
TEST(PosesThatComeAwayLittleByLittle, TakeTheMapAlong) {
  constexpr std::size_t kFrames = 5, kFramesToFollow = 10;
  for (const char* road : {"motorway", "street", "curve"}) {
    const Frames drive(road, "inhouse", 9.0);
    const std::size_t at = drive.frames.size() - kFramesAfter;
    for (const Jump& jump :
         {Jump{.left_m = 0.8}, Jump{.left_m = -0.8}, Jump{.turn_deg = 3.0}, Jump{.turn_deg = -3.0}}) {
      Mapper with{MapperConfig{}}, without{MapperConfig{}};
      double sum_m = 0.0;
      for (std::size_t i = 0; i < drive.frames.size(); ++i) {
        const double share =
            std::clamp((static_cast<double>(i) - static_cast<double>(at)) / kFrames, 0.0, 1.0);
        const Jump part{.left_m = share * jump.left_m, .turn_deg = share * jump.turn_deg};
        const Eigen::Isometry3d pose =
            drive.poses[at] * part.motion() * drive.poses[at].inverse() * drive.poses[i];
        const Seen seen{with.update(drive.frames[i], pose), pose},
            undisturbed{without.update(drive.frames[i], drive.poses[i]), drive.poses[i]};
        if (i >= at + kFramesToFollow) sum_m += apart_m(seen, undisturbed);
      }
      EXPECT_LT(sum_m / (kFramesAfter - kFramesToFollow), kMaxApart_m)
          << road << ", " << ::testing::PrintToString(jump);
    }
  }
}

TEST(PoseJumpsOfOrdinaryDrives, AreNotFound) {
  for (const std::string& scenario : simulation::scenario_names()) {
    for (const char* noise : {"none", "inhouse", "av2"}) {
      const Frames drive(scenario, noise, 40.0, 7);
      Mapper mapper{MapperConfig{}};
      for (std::size_t i = 0; i < drive.frames.size(); ++i) {
        mapper.update(drive.frames[i], drive.poses[i]);
        ASSERT_FALSE(mapper.poses_jumped()) << scenario << " " << noise << " frame " << i;
      }
    }
  }
}

}  // namespace
}  // namespace laneloom
