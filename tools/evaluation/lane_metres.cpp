#include "evaluation/lane_metres.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "evaluation/evaluation.hpp"
#include "evaluation/linkages.hpp"
#include "laneloom/polyline.hpp"
#include "mapping/geometry/levels.hpp"

namespace laneloom::evaluation {
namespace {

constexpr double kStep_m = 0.5;
constexpr double kTruthStep_m = 0.2;  // so that distances are wrong by 1 cm at most
constexpr double kStraddling_m = 1.0;
constexpr double kBesideEdge_m = 3.0;
constexpr double kNear_m = 0.9, kThere_m = 1.5;  // from a driven path to the middle of a lane
constexpr double kAlong = 0.7071;                // 45 degrees

/// In the middle of the lane; 0: the truth does not give its borders.
double width_of(const simulation::RoadLane& lane) {
  if (lane.left.empty() || lane.right.empty()) return 0.0;
  const Point middle = lane.centerline[lane.centerline.size() / 2];
  return MeasuredPolyline(lane.left).project(middle).distance_m +
         MeasuredPolyline(lane.right).project(middle).distance_m;
}

}  // namespace

double LaneMetres::published_m() const { return std::accumulate(by_class_m.begin(), by_class_m.end(), 0.0); }

LaneMetres& LaneMetres::operator+=(const LaneMetres& other) {
  for (std::size_t i = 0; i < kLaneClassCount; ++i) by_class_m[i] += other.by_class_m[i];
  told_m += other.told_m;
  told_right_m += other.told_right_m;
  shoulder_m += other.shoulder_m;
  shoulder_outside_m += other.shoulder_outside_m;
  driven_m += other.driven_m;
  driven_near_m += other.driven_near_m;
  driven_there_m += other.driven_there_m;
  driven_belief_m += other.driven_belief_m;
  return *this;
}

void LaneMetresMeter::sample(const Polyline& line, Of of, double width_m, std::vector<Sample>& samples) {
  const MeasuredPolyline measured(line);
  for (double arc_m = 0.0; arc_m <= measured.length(); arc_m += kTruthStep_m)
    samples.push_back({measured.at(arc_m), measured.direction(arc_m), of, 0.5 * width_m});
}

LaneMetresMeter::LaneMetresMeter(const simulation::Road& truth, const RangeConfig& range) : range_(range) {
  std::vector<Sample> samples;
  for (const simulation::RoadLane& lane : truth.lanes)
    sample(lane.centerline, Of::lane, width_of(lane), samples);
  for (const simulation::RoadMarking& marking : truth.markings)
    if (marking.type != MarkingType::stopline)
      sample(marking.points, marking.type == MarkingType::roadedge ? Of::roadedge : Of::laneline, 0.0,
             samples);
  truth_ = geometry::PointGrid<Sample>(std::move(samples), kBesideEdge_m);
}

void LaneMetresMeter::add_sample(const Point& point, const Eigen::Vector2d& direction, Lane::Direction told) {
  std::array<double, 3> nearest_m;
  nearest_m.fill(std::numeric_limits<double>::infinity());
  bool in_lane = false, runs_with_traffic = false;
  truth_.around(point, kBesideEdge_m, [&](const Sample& sample) {
    const double distance_m = (sample.position - point).head<2>().norm();
    if (!geometry::same_level(sample.position, point)) return;
    double& nearest = nearest_m[static_cast<std::size_t>(sample.of)];
    nearest = std::min(nearest, distance_m);
    if (sample.of != Of::lane) return;
    in_lane |= distance_m <= sample.half_width_m;
    runs_with_traffic |=
        distance_m < kMatchDistance_m && may_run(told, sample.direction.dot(direction) < 0.0);
  });
  const auto within = [&](Of of, double reach_m) {
    return nearest_m[static_cast<std::size_t>(of)] < reach_m;
  };
  LaneClass lane_class = LaneClass::elsewhere;
  if (within(Of::lane, kMatchDistance_m))
    lane_class = LaneClass::right;
  else if (within(Of::laneline, kStraddling_m))
    lane_class = LaneClass::straddling;
  else if (in_lane)
    lane_class = LaneClass::offset;
  else if (within(Of::roadedge, kBesideEdge_m))
    lane_class = LaneClass::beside_edge;
  metres_.by_class_m[static_cast<std::size_t>(lane_class)] += kStep_m;
  if (lane_class != LaneClass::right || told == Lane::Direction::unknown) return;
  metres_.told_m += kStep_m;
  if (runs_with_traffic) metres_.told_right_m += kStep_m;
}

void LaneMetresMeter::add_shoulder(const Point& point) {
  bool in_lane = false;
  truth_.around(point, kBesideEdge_m, [&](const Sample& sample) {
    in_lane |= sample.of == Of::lane && geometry::same_level(sample.position, point) &&
               (sample.position - point).head<2>().norm() <= sample.half_width_m;
  });
  metres_.shoulder_m += kStep_m;
  if (!in_lane) metres_.shoulder_outside_m += kStep_m;
}

void LaneMetresMeter::add_driven(const Point& point, const Eigen::Vector2d& direction, double probability) {
  double nearest_m = std::numeric_limits<double>::infinity();
  truth_.around(point, kThere_m, [&](const Sample& sample) {
    if (sample.of != Of::lane || !geometry::same_level(sample.position, point)) return;
    if (sample.direction.dot(direction) < kAlong) return;
    nearest_m = std::min(nearest_m, (sample.position - point).head<2>().norm());
  });
  metres_.driven_m += kStep_m;
  metres_.driven_belief_m += probability * kStep_m;
  if (nearest_m < kNear_m) metres_.driven_near_m += kStep_m;
  if (nearest_m < kThere_m) metres_.driven_there_m += kStep_m;
}

void LaneMetresMeter::add(const LocalMap& map) {
  const Eigen::Isometry3d T_body_map = map.T_map_body.inverse();
  for (const Lane& lane : map.lanes) {
    const MeasuredPolyline line(lane.centerline);
    for (double arc_m = 0.5 * kStep_m; arc_m < line.length(); arc_m += kStep_m) {
      const Point point = line.at(arc_m);
      if (!in_range(T_body_map * point, range_)) continue;
      if (lane.is_drivable())
        add_sample(point, line.direction(arc_m), lane.direction);
      else
        add_shoulder(point);
    }
  }
  for (const DrivenPath& path : map.driven_paths) {
    const MeasuredPolyline line(path.points);
    for (double arc_m = 0.5 * kStep_m; arc_m < line.length(); arc_m += kStep_m)
      if (in_range(T_body_map * line.at(arc_m), range_))
        add_driven(line.at(arc_m), line.direction(arc_m), path.probability);
  }
}

}  // namespace laneloom::evaluation
