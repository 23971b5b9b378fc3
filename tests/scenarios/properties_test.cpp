#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "contract/contract.hpp"
#include "laneloom/mapper.hpp"
#include "laneloom/polyline.hpp"
#include "session/mapping_session.hpp"
#include "simulation/perception.hpp"
#include "simulation/scenarios.hpp"

/// What holds of the maps of any road and any network. Networks are drawn at random.
namespace laneloom {
namespace {

constexpr double kMaxLanesOverlap = 0.15;  // share of the maps in which lanes overlap
constexpr double kMaxUnmirrored = 0.05;    // share of the places in lanes

struct Random {
  const char* scenario;
  std::uint64_t network;
};

void PrintTo(const Random& random, std::ostream* out) { *out << random.scenario << " " << random.network; }

/// A mapper behind a network on a road, frame by frame.
class RandomDrive {
 public:
  explicit RandomDrive(const Random& random)
      : road_(simulation::make_scenario(random.scenario)),
        perception_(road_, simulation::noise_profile("random:" + std::to_string(random.network)),
                    simulation::SensorView{}, random.network) {}

  /// The next frame of the first 40 s; false: they are over.
  bool next() {
    const double time_s = 0.1 * ++number_;
    if (time_s > std::min(40.0, road_.drive.duration_s())) return false;
    pose = road_.drive.pose_at(time_s);
    frame = perception_.observe(pose);
    T_map_body = transform(pose);
    return true;
  }

  DetectionFrame frame;
  VehiclePose pose;
  Eigen::Isometry3d T_map_body = Eigen::Isometry3d::Identity();

 private:
  simulation::Road road_;
  simulation::Perception perception_;
  int number_ = 0;
};

Point mirrored(const Point& point) { return {point.x(), -point.y(), point.z()}; }

Polyline mirrored(const Polyline& line) {
  Polyline out;
  for (const Point& point : line) out.push_back(mirrored(point));
  return out;
}

/// Seen in a mirror that stands along x.
Eigen::Isometry3d mirrored(const Eigen::Isometry3d& T_map_body) {
  const Eigen::Vector3d flip(1.0, -1.0, 1.0);
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  out.linear() = flip.asDiagonal() * T_map_body.linear() * flip.asDiagonal();
  out.translation() = mirrored(Point(T_map_body.translation()));
  return out;
}

DetectionFrame mirrored(DetectionFrame frame) {
  for (Detection& detection : frame.detections) detection.points = mirrored(detection.points);
  frame.field_of_view = mirrored(frame.field_of_view);
  for (Polyline& area : frame.occluded_areas) area = mirrored(area);
  return frame;
}

std::vector<Polyline> centerlines(const LocalMap& map) {
  std::vector<Polyline> lines;
  for (const Lane& lane : map.lanes) lines.push_back(lane.centerline);
  return lines;
}

std::vector<Polyline> marking_lines(const LocalMap& map) {
  std::vector<Polyline> lines;
  for (const Marking& marking : map.markings) lines.push_back(marking.points);
  return lines;
}

/// Places on lines near the vehicle, metre by metre, and the number of them that no other line is near.
struct Compared {
  std::size_t places = 0, alone = 0;

  double alone_share() const { return static_cast<double>(alone) / static_cast<double>(places); }
};

void compare(const std::vector<Polyline>& lines, const std::vector<Polyline>& others,
             const Eigen::Isometry3d& T_map_body, double near_m, Compared& compared) {
  const Eigen::AlignedBox2d near(Eigen::Vector2d(-2.0, -8.0), Eigen::Vector2d(20.0, 8.0));
  const std::vector<MeasuredPolyline> measured(others.begin(), others.end());
  for (const Polyline& line : lines) {
    for (const Point& place : MeasuredPolyline(line).resample(1.0)) {
      if (!near.contains((T_map_body.inverse() * place).head<2>().eval())) continue;
      ++compared.places;
      const auto is_near = [&](const MeasuredPolyline& other) {
        return other.project(place).distance_m <= near_m;
      };
      if (std::ranges::none_of(measured, is_near)) ++compared.alone;
    }
  }
}

class RandomRoads : public ::testing::TestWithParam<Random> {};

TEST_P(RandomRoads, BordersOfALaneNeverCross) {
  RandomDrive drive(GetParam());
  Mapper mapper{MapperConfig{}};
  std::size_t lanes = 0;
  while (drive.next()) {
    for (const Lane& lane : mapper.update(drive.frame, drive.T_map_body).lanes) {
      EXPECT_FALSE(intersect(lane.left, lane.right, 2.0)) << "lane " << lane.id;
      ++lanes;
    }
  }
  EXPECT_GT(lanes, 50U);
}

TEST_P(RandomRoads, LanesSeldomOverlap) {
  RandomDrive drive(GetParam());
  Mapper mapper{MapperConfig{}};
  int maps = 0, overlapping = 0;
  for (; drive.next(); ++maps)
    if (!contract::check_lanes_apart(mapper.update(drive.frame, drive.T_map_body)).empty()) ++overlapping;
  EXPECT_LE(overlapping, kMaxLanesOverlap * maps);
}

TEST_P(RandomRoads, AMirroredRoadGivesTheMirroredMap) {
  RandomDrive drive(GetParam());
  MapperConfig config;
  Mapper mapper{config};
  config.direction.driving_side = DrivingSide::left;
  Mapper mirror{config};
  Compared markings, lanes;
  while (drive.next()) {
    const LocalMap& map = mapper.update(drive.frame, drive.T_map_body);
    LocalMap seen = mirror.update(mirrored(drive.frame), mirrored(drive.T_map_body));
    for (Marking& marking : seen.markings) marking.points = mirrored(marking.points);
    for (Lane& lane : seen.lanes) lane.centerline = mirrored(lane.centerline);
    compare(marking_lines(map), marking_lines(seen), drive.T_map_body, 1e-3, markings);
    compare(centerlines(map), centerlines(seen), drive.T_map_body, 0.1, lanes);
  }
  EXPECT_GT(markings.places, 5000U);
  EXPECT_EQ(markings.alone, 0U) << "of " << markings.places;
  EXPECT_GT(lanes.places, 5000U);
  EXPECT_LE(lanes.alone_share(), kMaxUnmirrored);
}

TEST_P(RandomRoads, AMessageThatRepeatsChangesNothing) {
  RandomDrive drive(GetParam());
  session::MappingSession once{Config{}}, twice{Config{}};
  std::size_t lanes = 0;
  while (drive.next()) {
    once.add(drive.pose);
    once.add(drive.frame, drive.frame.stamp_ns);
    for (int i = 0; i < 2; ++i) twice.add(drive.pose);
    for (int i = 0; i < 2; ++i) twice.add(drive.frame, drive.frame.stamp_ns);
    EXPECT_EQ(centerlines(once.map()), centerlines(twice.map()));
    EXPECT_EQ(marking_lines(once.map()), marking_lines(twice.map()));
    lanes += once.map().lanes.size();
  }
  EXPECT_GT(lanes, 50U);
}

// What is learned of a network, it is learned of all its lines: so nothing is learned here.
TEST_P(RandomRoads, ALineFarAwayChangesNothingNear) {
  RandomDrive drive(GetParam());
  MapperConfig config;
  config.fusion.learn = false;
  Mapper mapper{config}, other{config};
  Compared markings, lanes;
  while (drive.next()) {
    const LocalMap& map = mapper.update(drive.frame, drive.T_map_body);
    drive.frame.detections.push_back({.type = MarkingType::roadedge,
                                      .style = MarkingStyle::solid,
                                      .confidence = 0.7,
                                      .points = {{5, 40, 0}, {25, 40, 0}}});
    const LocalMap& seen = other.update(drive.frame, drive.T_map_body);
    compare(marking_lines(map), marking_lines(seen), drive.T_map_body, 1e-9, markings);
    compare(centerlines(map), centerlines(seen), drive.T_map_body, 1e-9, lanes);
  }
  EXPECT_GT(lanes.places, 5000U);
  EXPECT_EQ(markings.alone, 0U) << "of " << markings.places;
  EXPECT_EQ(lanes.alone, 0U) << "of " << lanes.places;
}

INSTANTIATE_TEST_SUITE_P(Drives, RandomRoads,
                         ::testing::Values(Random{"town", 21}, Random{"motorway", 22}, Random{"street", 23},
                                           Random{"exit", 24}, Random{"country_road", 25}));

}  // namespace
}  // namespace laneloom
