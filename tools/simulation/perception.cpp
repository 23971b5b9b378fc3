#include "simulation/perception.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace laneloom {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kFramePeriod_s = 0.1;
constexpr double kMaxStep_s = 1.0;
constexpr double kMinLength_m = 1.0;

double reach_m(const SensorView& view) {
  const double ahead_m = std::max(std::abs(view.forward_min_m), std::abs(view.forward_max_m));
  return ahead_m + view.side_max_m + view.height_max_m;
}

double distance_m(const Polyline& line) {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const Point& p : MeasuredPolyline(line).resample(2.0))
    nearest_m = std::min(nearest_m, p.head<2>().norm());
  return nearest_m;
}

// Of pieces of a line; `period_m` is a ring's length, else 0.
double overlap_m(const Stretch& a, const Stretch& b, double period_m) {
  double most_m = -1.0;
  for (const double shift_m : {-period_m, 0.0, period_m})
    most_m = std::max(most_m, std::min(a.to_m, b.to_m + shift_m) - std::max(a.from_m, b.from_m + shift_m));
  return most_m;
}

}  // namespace

Perception::Perception(const Road& road, NoiseProfile noise, SensorView view, std::uint64_t seed)
    : noise_(std::move(noise)), view_(std::move(view)), random_(seed), frame_error_(random_) {
  for (const RoadMarking& marking : road.markings) {
    if (!view_.detects(marking.type)) continue;
    markings_.push_back(marking);
    lines_.emplace_back(marking.points);
  }
  for (const RoadLane& lane : road.lanes) {
    if (!lane.in_intersection) continue;
    crossings_.emplace_back(lane.left);
    crossings_.emplace_back(lane.right);
  }
}

DetectionFrame Perception::observe(const VehiclePose& pose) {
  const double dt_s = step_time(pose.stamp_ns);
  step_frame_error(dt_s);
  occluders_.step(dt_s, noise_, random_);
  sources_.clear();
  DetectionFrame frame;
  frame.stamp_ns = pose.stamp_ns;
  frame.sequence = ++sequence_;
  frame.source = "simulation";
  frame.detected_types = view_.detected_types;
  frame.field_of_view = view_.polygon();
  frame.occluded_areas = occluders_.areas();
  detect_markings(pose, dt_s, frame);
  step_ghosts(pose, dt_s);
  detect_ghosts(pose, frame);
  return frame;
}

double Perception::step_time(std::int64_t stamp_ns) {
  const double dt_s =
      last_stamp_ns_ ? static_cast<double>(stamp_ns - *last_stamp_ns_) * 1e-9 : kFramePeriod_s;
  last_stamp_ns_ = stamp_ns;
  return dt_s > 0.0 && dt_s <= kMaxStep_s ? dt_s : kFramePeriod_s;
}

void Perception::step_frame_error(double dt_s) {
  for (Wander* wander : {&frame_error_.yaw, &frame_error_.pitch, &frame_error_.longitudinal})
    wander->step(dt_s, noise_.frame_memory_s, random_);
  const auto turn = [](double angle_deg, const Point& axis) {
    return Eigen::AngleAxisd(angle_deg * kDegree, axis);
  };
  T_seen_body_ =
      Eigen::Translation3d(frame_error_.longitudinal.value() * noise_.frame_longitudinal_stddev_m, 0.0, 0.0) *
      turn(frame_error_.yaw.value() * noise_.frame_yaw_stddev_deg, Point::UnitZ()) *
      turn(frame_error_.pitch.value() * noise_.frame_pitch_stddev_deg, Point::UnitY());
}

// The piece's errors are those of the piece of the same marking that it overlaps most in the frame before.
Perception::Track& Perception::follow(std::vector<Track>& now, std::size_t marking, const VisiblePiece& piece,
                                      double dt_s) {
  const double away_m = distance_m(piece.points);
  const double period_m = lines_[marking].ring ? lines_[marking].line.length() : 0.0;
  auto best = tracks_.end();
  double most_m = 0.0;
  for (auto track = tracks_.begin(); track != tracks_.end(); ++track) {
    const double common_m = track->marking == marking ? overlap_m(track->arc, piece.arc, period_m) : 0.0;
    if (common_m <= most_m) continue;
    best = track;
    most_m = common_m;
  }
  if (best == tracks_.end()) {
    now.push_back({marking, piece.arc, LineNoise(noise_, markings_[marking].type, away_m, random_)});
  } else {
    now.push_back({marking, piece.arc, best->noise});
    tracks_.erase(best);
    now.back().noise.step(dt_s, noise_, away_m, random_);
  }
  return now.back();
}

void Perception::detect_markings(const VehiclePose& pose, double dt_s, DetectionFrame& frame) {
  const Eigen::Isometry3d T_body_map = transform(pose).inverse();
  std::vector<Track> now;
  for (std::size_t i = 0; i < markings_.size(); ++i) {
    if (!lines_[i].may_be_near(pose.position, reach_m(view_))) continue;
    for (const VisiblePiece& piece : visible_pieces(lines_[i], view_, T_body_map)) {
      const Track& track = follow(now, i, piece, dt_s);
      const bool dropped = random_.chance(noise_.dropped_probability);
      if (track.noise.missed() || dropped) continue;
      for (const Polyline& part : occluders_.visible_parts(piece.points)) {
        if (part.size() < 2 || length(part) < kMinLength_m) continue;
        for (const Detection& detection : track.noise.detect(part, markings_[i].style, noise_, random_))
          add(detection, markings_[i].id, frame);
      }
    }
  }
  tracks_ = std::move(now);
}

void Perception::step_ghosts(const VehiclePose& pose, double dt_s) {
  std::erase_if(ghosts_, [&](const Ghost&) { return random_.chance(dt_s / noise_.ghost_dwell_s); });
  std::vector<const ViewedLine*> in_view;
  for (const ViewedLine& crossing : crossings_) {
    if (crossing.may_be_near(pose.position, view_.side_max_m)) in_view.push_back(&crossing);
  }
  // At intersections networks go on with lines where none are.
  if (random_.chance(noise_.intersection_ghost_rate_hz * dt_s) && !in_view.empty())
    appear(random_.chance(0.4) ? MarkingType::roadedge : MarkingType::laneline,
           in_view[random_.below(in_view.size())]->line.points());
  for (const MarkingType type : kMarkingTypes) {
    if (!random_.chance(noise_.ghost_rate_hz.at(index(type)) * dt_s)) continue;
    const Point begin(random_.uniform(view_.forward_min_m, 0.6 * view_.forward_max_m),
                      random_.uniform(-0.6, 0.6) * view_.side_max_m, 0.0);
    const bool across = type == MarkingType::stopline;
    const double heading_rad = 10.0 * kDegree * random_.normal() + (across ? 90.0 * kDegree : 0.0);
    const double length_m = across ? random_.uniform(2.5, 7.0) : random_.uniform(5.0, 20.0);
    const Point end = begin + length_m * Point(std::cos(heading_rad), std::sin(heading_rad), 0.0);
    appear(type, {transform(pose) * begin, transform(pose) * end});
  }
}

void Perception::appear(MarkingType type, Polyline points_map) {
  if (!view_.detects(type)) return;
  const bool dashed = type == MarkingType::laneline && random_.chance(0.5);
  ghosts_.push_back({std::move(points_map),
                     {.type = type,
                      .style = dashed ? MarkingStyle::dashed : MarkingStyle::solid,
                      .confidence = std::clamp(noise_.ghost_confidence + 0.15 * random_.normal(), 0.02, 1.0),
                      .points = {},
                      .stddev_m = {}}});
}

void Perception::detect_ghosts(const VehiclePose& pose, DetectionFrame& frame) {
  const Eigen::Isometry3d T_body_map = transform(pose).inverse();
  for (const Ghost& ghost : ghosts_) {
    for (const VisiblePiece& piece : visible_pieces(ViewedLine(ghost.points_map), view_, T_body_map)) {
      Detection detection = ghost.detection;
      detection.points = piece.points;
      add(detection, kNoElement, frame);
    }
  }
}

void Perception::add(const Detection& detection, ElementId source, DetectionFrame& frame) {
  sources_.push_back(source);
  Detection& seen = frame.detections.emplace_back(detection);
  seen.points = as_network_output(detection.points);
  if (random_.chance(noise_.zigzag_probability)) make_zigzag(seen.points, noise_.zigzag_stddev_m, random_);
  for (Point& point : seen.points) point = T_seen_body_ * point;
}

}  // namespace laneloom
