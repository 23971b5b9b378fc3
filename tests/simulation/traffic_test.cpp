#include "simulation/traffic.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <stdexcept>

#include "simulation/scenarios.hpp"

namespace laneloom::simulation {
namespace {

class TrafficTest : public ::testing::Test {
 protected:
  TrafficTest() : road_(make_scenario("town", 10.0)) {
    for (const RoadLane& lane : road_.lanes) lines_.emplace_back(lane.centerline);
  }

  std::vector<TrackedObjects> drive(const TrafficProfile& profile, double duration_s,
                                    std::uint64_t seed = 1) const {
    Traffic traffic(road_, profile, seed);
    std::vector<TrackedObjects> seen;
    for (int i = 1; i <= 10.0 * duration_s; ++i) seen.push_back(traffic.observe(pose(i)));
    return seen;
  }
  VehiclePose pose(int tenths) const {
    VehiclePose pose = road_.drive.pose_at(0.1 * tenths);
    pose.stamp_ns = 100'000'000LL * tenths;
    return pose;
  }
  /// Whether an object lies on a lane, at most so far from its middle, and runs along it (1) or against it
  /// (-1).
  bool on_a_lane(const TrackedObject& object, const VehiclePose& from, double within_m, double sense) const {
    const Point place = transform(from) * object.position;
    const Point heading = transform(from).linear() * object.heading;
    for (const MeasuredPolyline& line : lines_) {
      const Projection foot = line.project(place, within_m);
      if (foot.distance_m > within_m) continue;
      if (sense * line.direction(foot).dot(heading.head<2>()) > 0.9) return true;
    }
    return false;
  }

  Road road_;
  std::vector<MeasuredPolyline> lines_;
};

TEST_F(TrafficTest, IsTheSameForTheSameSeed) {
  const auto one = drive(traffic_profile("usual"), 5.0), again = drive(traffic_profile("usual"), 5.0),
             other = drive(traffic_profile("usual"), 5.0, 2);
  bool differs = false;
  for (std::size_t i = 0; i < one.size(); ++i) {
    ASSERT_EQ(one[i].objects.size(), again[i].objects.size());
    differs = differs || one[i].objects.size() != other[i].objects.size();
    for (std::size_t k = 0; k < one[i].objects.size(); ++k)
      EXPECT_EQ(one[i].objects[k].position, again[i].objects[k].position);
  }
  EXPECT_TRUE(differs);
}

TEST_F(TrafficTest, DrivesAlongLanes) {
  TrafficProfile profile = traffic_profile("exact");
  profile.offset_stddev_m = profile.parked_per_km = profile.lane_changes_per_s = 0.0;
  const auto seen = drive(profile, 20.0);
  std::size_t late = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    for (const TrackedObject& object : seen[i].objects) {
      EXPECT_TRUE(on_a_lane(object, pose(static_cast<int>(i) + 1), 0.01, 1.0)) << i;
      EXPECT_GT(object.speed_mps, 1.0);
      if (2 * i > seen.size()) ++late;
    }
  }
  EXPECT_GT(late, seen.size()) << "vehicles come again where others left";
}

TEST_F(TrafficTest, AnExactTrackerFollowsWhatMoves) {
  const auto seen = drive(traffic_profile("exact"), 10.0);
  std::map<std::uint64_t, Point> last;
  std::set<std::uint64_t> followed;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    std::map<std::uint64_t, Point> now;
    for (const TrackedObject& object : seen[i].objects) {
      const Point place = transform(pose(static_cast<int>(i) + 1)) * object.position;
      now[object.id] = place;
      const auto before = last.find(object.id);
      if (before == last.end()) continue;
      followed.insert(object.id);
      EXPECT_LT((place - before->second).norm(), 0.1 * object.speed_mps + 0.5) << object.id;
    }
    last = std::move(now);
  }
  EXPECT_GT(followed.size(), 10U);
}

TEST_F(TrafficTest, ChangesLanesAndOvertakesWhereThereAreLanes) {
  TrafficProfile profile = traffic_profile("exact");
  profile.offset_stddev_m = profile.parked_per_km = 0.0;
  const auto on_the_wrong_side = [&] {
    std::size_t count = 0;
    const auto seen = drive(profile, 20.0);
    for (std::size_t i = 0; i < seen.size(); ++i)
      for (const TrackedObject& object : seen[i].objects)
        count += on_a_lane(object, pose(static_cast<int>(i) + 1), 0.3, -1.0) ? 1U : 0U;
    return count;
  };
  profile.lane_changes_per_s = 0.5;
  EXPECT_EQ(on_the_wrong_side(), 0U);
  profile.overtakings_per_s = 0.5;
  EXPECT_GT(on_the_wrong_side(), 20U);
}

TEST_F(TrafficTest, AHostileTrackerErrs) {
  const auto seen = drive(traffic_profile("hostile"), 20.0);
  std::set<std::uint64_t> usual, hostile;
  std::size_t against = 0, parked = 0, ghosts = 0;
  for (const TrackedObjects& message : drive(traffic_profile("usual"), 20.0))
    for (const TrackedObject& object : message.objects) usual.insert(object.id);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    for (const TrackedObject& object : seen[i].objects) {
      hostile.insert(object.id);
      against += on_a_lane(object, pose(static_cast<int>(i) + 1), 1.5, -1.0) ? 1U : 0U;
      parked += object.speed_mps == 0.0 ? 1U : 0U;
      ghosts += object.existence_probability == 0.6 ? 1U : 0U;
    }
  }
  EXPECT_GT(hostile.size(), 3 * usual.size()) << "ids change";
  EXPECT_GT(against, 50U);
  EXPECT_GT(parked, 50U);
  EXPECT_GT(ghosts, 50U);
}

TEST_F(TrafficTest, ProfilesHaveNames) {
  for (const std::string& name : traffic_profile_names()) EXPECT_NO_THROW(traffic_profile(name)) << name;
  EXPECT_THROW(traffic_profile("none"), std::invalid_argument);
}

}  // namespace
}  // namespace laneloom::simulation
