#include "evaluation/later.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "laneloom/polyline.hpp"

namespace laneloom::evaluation {
namespace {

constexpr double kNearest_m = 6.0, kFarthest_m = 10.0;  // ahead: close by
constexpr double kPointDistance_m = 0.5;                // between the points of lines that are seen close by
constexpr double kLongest_m = 1000.0;                   // what is longer has a wrong point, and is no witness
constexpr double kHalfLength_m = 2.0;                   // of a place, along the road
constexpr double kHalfWidth_m = 12.0;                   // of a place, across the road
constexpr double kGap_m = 0.6, kLargestSpread_m = 1.0;  // of the points of one line
constexpr std::size_t kFewestPoints = 6;
constexpr double kMatch_m = 0.5;
constexpr std::ptrdiff_t kFewestWitnesses = 2;
constexpr double kOwnLaneAhead_m = 8.0;
constexpr std::int64_t kWarmUp_ns = 2'000'000'000;
constexpr double kLeastStep_m = 0.5, kLargestStep_m = 10.0;

std::optional<double> share(std::size_t part, std::size_t whole) {
  if (whole == 0) return std::nullopt;
  return static_cast<double>(part) / static_cast<double>(whole);
}

Polyline transformed(const Polyline& points, const Eigen::Isometry3d& transform) {
  Polyline result;
  result.reserve(points.size());
  for (const Point& point : points) result.push_back(transform * point);
  return result;
}

/// Adds the offsets at which a line crosses the road at a place.
void add_crossings(const Polyline& line, const Eigen::Isometry3d& T_there_map, std::vector<double>& offsets) {
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Point from = T_there_map * line[i - 1], to = T_there_map * line[i];
    if ((from.x() <= 0.0) == (to.x() <= 0.0)) continue;
    const double y = from.y() - from.x() * (to.y() - from.y()) / (to.x() - from.x());
    if (std::abs(y) < kHalfWidth_m) offsets.push_back(y);
  }
}

std::vector<double> crossings(const std::vector<Polyline>& lines, const Eigen::Isometry3d& T_there_map) {
  std::vector<double> offsets;
  for (const Polyline& line : lines) add_crossings(line, T_there_map, offsets);
  return offsets;
}

double median(const double* begin, const double* end) {
  const std::ptrdiff_t count = end - begin;
  return 0.5 * (begin[(count - 1) / 2] + begin[count / 2]);
}

/// Offsets of the lines that sorted offsets of points show.
std::vector<double> lines_of(const std::vector<double>& points) {
  std::vector<double> lines;
  const double* const end = points.data() + points.size();
  for (const double* first = points.data(); first != end;) {
    const double* last = first + 1;
    while (last != end && *last - *(last - 1) <= kGap_m) ++last;
    const bool enough = last - first >= static_cast<std::ptrdiff_t>(kFewestPoints);
    if (enough && *(last - 1) - *first < kLargestSpread_m) lines.push_back(median(first, last));
    first = last;
  }
  return lines;
}

bool seen_at(double offset, const std::vector<double>& points) {
  const auto first = std::upper_bound(points.begin(), points.end(), offset - kMatch_m);
  return std::lower_bound(first, points.end(), offset + kMatch_m) - first >= kFewestWitnesses;
}

/// The distance of the nearest line from one seen later. None: no line is near enough.
std::optional<double> error_at(double seen, const std::vector<double>& lines) {
  double least = kMatch_m;
  for (const double line : lines) least = std::min(least, std::abs(line - seen));
  return least < kMatch_m ? std::optional(least) : std::nullopt;
}

}  // namespace

void LaterMeter::add_detections(const DetectionFrame& frame, Moment& moment) const {
  for (const Detection& detection : frame.detections) {
    if (detection.confidence < min_confidence_) continue;
    const std::size_t type = index(detection.type);
    moment.single[type].push_back(transformed(detection.points, moment.T_map_body));
    const MeasuredPolyline line(detection.points);
    if (line.length() > kLongest_m) continue;
    for (const Point& point : line.resample(kPointDistance_m))
      if (point.x() >= kNearest_m && point.x() <= kFarthest_m) {
        moment.nearby[type].push_back(moment.T_map_body * point);
        moment.sides.right_m = std::min(moment.sides.right_m, point.y());
        moment.sides.left_m = std::max(moment.sides.left_m, point.y());
      }
  }
}

void LaterMeter::add(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body, const LocalMap& map) {
  double driven_m = 0.0;
  if (!moments_.empty()) {
    const Moment& last = moments_.back();
    const double step_m = (T_map_body.translation() - last.T_map_body.translation()).head<2>().norm();
    if (step_m < kLeastStep_m) return;
    if (step_m >= kLargestStep_m)
      moments_.clear();
    else
      driven_m = last.driven_m + step_m;
  }
  if (driven_m == 0.0) begin_ns_ = frame.stamp_ns;
  Moment& moment = moments_.emplace_back();
  moment.stamp_ns = frame.stamp_ns;
  moment.T_map_body = T_map_body;
  moment.driven_m = driven_m;
  moment.lanes = map.lanes;
  add_detections(frame, moment);
  for (const Marking& boundary : map.boundaries)
    if (boundary.status != ElementStatus::inferred)
      moment.map[index(boundary.type)].push_back(boundary.points);
  while (moments_.front().driven_m + kLaterDistances_m.back() <= driven_m) rate_first();
}

/// The pose of the vehicle this distance after the first moment.
Eigen::Isometry3d LaterMeter::pose_ahead(double distance_m) const {
  const double driven_m = moments_.front().driven_m + distance_m;
  const auto after = std::find_if(moments_.begin(), moments_.end(),
                                  [&](const Moment& moment) { return moment.driven_m >= driven_m; });
  const Moment &to = *after, &from = *std::prev(after);
  const double share = (driven_m - from.driven_m) / (to.driven_m - from.driven_m);
  const Eigen::Quaterniond rotation(from.T_map_body.linear());
  const Point step = to.T_map_body.translation() - from.T_map_body.translation();
  return Eigen::Translation3d(from.T_map_body.translation() + share * step) *
         rotation.slerp(share, Eigen::Quaterniond(to.T_map_body.linear()));
}

/// Offsets of the points that are seen later at a place, ascending. They are from moments before the vehicle
/// passes the place.
std::vector<double> LaterMeter::seen_later(MarkingType type, double distance_m,
                                           const Eigen::Isometry3d& T_there_map) const {
  std::vector<double> offsets;
  for (auto moment = std::next(moments_.begin()); moment != moments_.end(); ++moment) {
    if (moment->driven_m > moments_.front().driven_m + distance_m) break;
    for (const Point& point : moment->nearby[index(type)]) {
      const Point there = T_there_map * point;
      if (std::abs(there.x()) < kHalfLength_m && std::abs(there.y()) < kHalfWidth_m)
        offsets.push_back(there.y());
    }
  }
  std::sort(offsets.begin(), offsets.end());
  return offsets;
}

/// Whether a later frame has the place close ahead. With a few frames per second, some places are passed
/// over.
bool LaterMeter::looked_at(double distance_m) const {
  const double there_m = moments_.front().driven_m + distance_m;
  return std::any_of(std::next(moments_.begin()), moments_.end(), [&](const Moment& moment) {
    const double ahead_m = there_m - moment.driven_m;
    return ahead_m >= kNearest_m && ahead_m <= kFarthest_m;
  });
}

LaterMeter::Sides LaterMeter::sides_seen() const {
  Sides sides;
  for (const Moment& moment : moments_) {
    sides.right_m = std::min(sides.right_m, moment.sides.right_m - kMatch_m);
    sides.left_m = std::max(sides.left_m, moment.sides.left_m + kMatch_m);
  }
  return sides;
}

void LaterMeter::rate_lines(std::size_t distance, const Sides& sides) {
  const double distance_m = kLaterDistances_m[distance];
  if (!looked_at(distance_m)) return;
  const Eigen::Isometry3d T_there_map = pose_ahead(distance_m).inverse();
  const auto add_precision = [&](const std::vector<double>& lines, const std::vector<double>& points,
                                 LaterScore::Subject& subject) {
    for (const double line : lines) {
      if (line < sides.right_m || line > sides.left_m) continue;
      ++subject.lines;
      if (seen_at(line, points)) ++subject.right;
    }
  };
  for (const MarkingType type : kLaterTypes) {
    LaterScore& score = scores_[distance][index(type)];
    const std::vector<double> points = seen_later(type, distance_m, T_there_map);
    const std::vector<double> single = crossings(moments_.front().single[index(type)], T_there_map);
    const std::vector<double> map = crossings(moments_.front().map[index(type)], T_there_map);
    add_precision(single, points, score.single);
    add_precision(map, points, score.map);
    for (const double line : lines_of(points)) {
      const std::optional<double> of_single = error_at(line, single), of_map = error_at(line, map);
      ++score.seen_later;
      if (of_single) ++score.single.found;
      if (of_map) ++score.map.found;
      if (!of_single || !of_map) continue;
      score.single.lateral_errors_m.add(*of_single);
      score.map.lateral_errors_m.add(*of_map);
    }
  }
}

void LaterMeter::rate_own_lane() {
  const Eigen::Isometry3d T_there_map = pose_ahead(kOwnLaneAhead_m).inverse();
  for (const Lane& lane : moments_.front().lanes) {
    const std::vector<double> left = crossings({lane.left}, T_there_map);
    const std::vector<double> right = crossings({lane.right}, T_there_map);
    if (left.empty() || right.empty() || (left[0] > 0.0) == (right[0] > 0.0)) continue;
    ++own_lane_.frames;
    own_lane_.widths_m.add(std::abs(left[0] - right[0]));
    if (last_own_lane_ != kNoElement && last_own_lane_ != lane.id) ++own_lane_.id_changes;
    last_own_lane_ = lane.id;
    return;
  }
}

void LaterMeter::rate_first() {
  const Moment& first = moments_.front();
  if (first.stamp_ns - begin_ns_ >= kWarmUp_ns) {
    ++frames_;
    lanes_ += first.lanes.size();
    driven_m_ += moments_[1].driven_m - first.driven_m;
    for (std::size_t i = 0; i < kLaterDistances_m.size(); ++i) rate_lines(i, sides_seen());
    rate_own_lane();
    rated_ns_ = first.stamp_ns;
  }
  moments_.pop_front();
}

LaterScore LaterMeter::take_scores() {
  LaterScore sum;
  const auto add = [](const LaterScore::Subject& from, LaterScore::Subject& to) {
    to.lines += from.lines;
    to.right += from.right;
    to.found += from.found;
    to.lateral_errors_m.add(from.lateral_errors_m);
  };
  for (const auto& by_type : std::exchange(scores_, {}))
    for (const LaterScore& score : by_type) {
      sum.seen_later += score.seen_later;
      add(score.single, sum.single);
      add(score.map, sum.map);
    }
  own_lane_.widths_m = {};
  return sum;
}

bool LaterMeter::any() const {
  for (const auto& by_type : scores_)
    for (const LaterScore& score : by_type)
      if (score.seen_later > 0) return true;
  return false;
}

LaterScore::Figures LaterScore::figures(const Subject& subject) const {
  Figures result{share(subject.right, subject.lines), share(subject.found, seen_later), {}, {}};
  if (subject.lateral_errors_m.count() == 0) return result;
  result.rms_m = subject.lateral_errors_m.root_mean_square();
  result.p95_m = subject.lateral_errors_m.quantile(0.95);
  return result;
}

void require_rated(const LaterMeter& meter, const std::string& name) {
  if (meter.frames() == 0)
    throw std::runtime_error(fmt::format(
        "{}: too short to be rated: after 2 s, the vehicle must drive {:g} m more, with detections and maps",
        name, kLaterDistances_m.back()));
  if (!meter.any())
    throw std::runtime_error(fmt::format(
        "{}: cannot be rated: in {:.0f} m, nothing was seen 6 to 10 m ahead of the vehicle that was to be "
        "found before",
        name, meter.driven_m()));
}

}  // namespace laneloom::evaluation
