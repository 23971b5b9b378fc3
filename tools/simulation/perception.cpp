#include "simulation/perception.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace laneloom::simulation {
namespace {

constexpr double kFramePeriod_s = 0.1;
constexpr double kMaxStep_s = 1.0;
constexpr double kMinLength_m = 1.0;
constexpr double kMinConfidence = 0.02;

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

// The overlap of two pieces of a line. `period_m` is a ring's length, or else 0.
double overlap_m(const Stretch& a, const Stretch& b, double period_m) {
  double most_m = -1.0;
  for (const double shift_m : {-period_m, 0.0, period_m})
    most_m = std::max(most_m, std::min(a.to_m, b.to_m + shift_m) - std::max(a.from_m, b.from_m + shift_m));
  return most_m;
}

}  // namespace

Perception::Perception(const Road& road, NoiseProfile noise, SensorView view, std::uint64_t seed)
    : noise_(std::move(noise)), view_(std::move(view)), random_(seed), ghosts_(road), frame_noise_(random_) {
  for (const RoadMarking& marking : road.markings) {
    if (!view_.detects(marking.type)) continue;
    const ViewedLine& viewed = lines_.emplace_back(marking.points);
    places_.emplace_back(seed, lines_.size(), viewed.line.length(), viewed.ring);
    markings_.push_back(marking);
  }
}

DetectionFrame Perception::observe(const VehiclePose& pose) {
  const double dt_s = step_time(pose.stamp_ns);
  frame_noise_.step(dt_s, noise_, random_);
  occluders_.step(dt_s, noise_, random_);
  sources_.clear();
  DetectionFrame frame;
  frame.stamp_ns = pose.stamp_ns;
  frame.sequence = ++sequence_;
  frame.source = "simulation";
  frame.detected_types = view_.detected_types;
  if (noise_.tells_view) {
    frame.field_of_view = view_.polygon();
    frame.occluded_areas = occluders_.areas();
  }
  const std::vector<Polyline> in_view = detect_markings(pose, dt_s, frame);
  ghosts_.step(pose, in_view, dt_s, noise_, view_, random_);
  for (const Detection& ghost : ghosts_.detections(pose, noise_, view_, random_))
    add(ghost, kNoElement, frame);
  return frame;
}

double Perception::step_time(std::int64_t stamp_ns) {
  const double dt_s =
      last_stamp_ns_ ? static_cast<double>(stamp_ns - *last_stamp_ns_) * 1e-9 : kFramePeriod_s;
  last_stamp_ns_ = stamp_ns;
  return dt_s > 0.0 && dt_s <= kMaxStep_s ? dt_s : kFramePeriod_s;
}

// The errors of a piece. It continues those of the piece of the same marking that it overlaps most in the
// frame before.
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

// The parts of a piece that are not missed for the whole drive.
std::vector<VisiblePiece> Perception::found_parts(std::size_t marking, const VisiblePiece& piece) const {
  const Places& places = places_[marking];
  const std::size_t type = index(markings_[marking].type);
  const double share = noise_.missed_share.at(type) * noise_.missed_lasting.at(type);
  if (share <= 0.0) return {piece};
  const MeasuredPolyline measured(piece.points);
  std::vector<Stretch> found;
  for (double from_m = piece.arc.from_m; from_m < piece.arc.to_m;) {
    // Rounding must not stop the progress.
    const double to_m = std::min(piece.arc.to_m, std::max(places.stretch_end_m(from_m), from_m + 1e-6));
    if (!places.among(share, Trait::missed, from_m)) {
      if (!found.empty() && found.back().to_m == from_m) {
        found.back().to_m = to_m;
      } else {
        found.push_back({from_m, to_m});
      }
    }
    from_m = to_m;
  }
  std::vector<VisiblePiece> parts;
  for (const Stretch& arc : found) {
    const Stretch local{arc.from_m - piece.arc.from_m, arc.to_m - piece.arc.from_m};
    if (local.to_m > local.from_m) parts.push_back({arc, measured.slice(local)});
  }
  return parts;
}

std::vector<Polyline> Perception::detect_markings(const VehiclePose& pose, double dt_s,
                                                  DetectionFrame& frame) {
  const Eigen::Isometry3d T_body_map = transform(pose).inverse();
  std::vector<Polyline> in_view;
  std::vector<Track> now;
  for (std::size_t i = 0; i < markings_.size(); ++i) {
    if (!lines_[i].may_be_near(pose.position, reach_m(view_))) continue;
    for (const VisiblePiece& piece : visible_pieces(lines_[i], view_, T_body_map)) {
      if (markings_[i].type != MarkingType::stopline) in_view.push_back(piece.points);
      const Track& track = follow(now, i, piece, dt_s);
      const bool dropped = random_.chance(noise_.dropped_probability);
      if (!track.noise.missed() && !dropped) detect(i, track.noise, piece, frame);
    }
  }
  tracks_ = std::move(now);
  return in_view;
}

void Perception::detect(std::size_t marking, const LineNoise& line, const VisiblePiece& piece,
                        DetectionFrame& frame) {
  for (const VisiblePiece& found : found_parts(marking, piece)) {
    for (const VisiblePiece& part : occluders_.visible_parts(found)) {
      if (part.points.size() < 2 || length(part.points) < kMinLength_m) continue;
      for (const LineNoise::Seen& seen :
           line.detect(part, markings_[marking].style, noise_, places_[marking], random_))
        add(seen.detection, seen.of_line ? markings_[marking].id : kNoElement, frame);
    }
  }
}

void Perception::add(const Detection& detection, ElementId source, DetectionFrame& frame) {
  sources_.push_back(source);
  Detection& seen = frame.detections.emplace_back(detection);
  seen.confidence = std::clamp(detection.confidence + frame_noise_.confidence(), kMinConfidence, 1.0);
  seen.points = as_network_output(detection.points);
  if (random_.chance(noise_.zigzag_probability)) make_zigzag(seen.points, noise_.zigzag_stddev_m, random_);
  for (Point& point : seen.points) point = frame_noise_.seen(point);
}

}  // namespace laneloom::simulation
