#include "session/gate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/degree.hpp"
#include "base/seconds.hpp"
#include "base/unit_rotation.hpp"

namespace laneloom::session {
namespace {

constexpr int kOutliersToBelieve = 3;
constexpr double kLateToBelieve_s = 0.2;
constexpr std::size_t kSessionsRemembered = 8;
constexpr double kMaxHeadingError = 1e-3;  // of its length

bool plausible_stamp(std::int64_t stamp_ns) { return stamp_ns > 0 && stamp_ns < kMaxStamp_ns; }

// Written so that NaN is refused.
bool within(const Point& point, double max_m) {
  return point.cwiseAbs().maxCoeff() <= max_m && !point.hasNaN();
}

bool within(const Polyline& line, double max_m) {
  return std::all_of(line.begin(), line.end(), [=](const Point& point) { return within(point, max_m); });
}

std::string_view defect(const Detection& detection, const GateConfig& config) {
  if (detection.points.size() < 2) return "too_few_points";
  if (!within(detection.points, config.max_coordinate_m)) return "coordinate";
  if (!(detection.confidence >= 0.0 && detection.confidence <= 1.0)) return "confidence";
  const auto& stddev_m = detection.stddev_m;
  if (!stddev_m.empty() && stddev_m.size() != detection.points.size()) return "wrong_size";
  const auto plausible = [](double value) { return value >= 0.0 && std::isfinite(value); };
  if (!std::all_of(stddev_m.begin(), stddev_m.end(), plausible)) return "stddev";
  return {};
}

/// A length that is given, or is -1.
bool plausible_length(double length_m) {
  return length_m == -1.0 || (length_m >= 0.0 && std::isfinite(length_m));
}

std::string_view defect(const TrackedObject& object, const GateConfig& config) {
  if (!within(object.position, config.max_coordinate_m)) return "coordinate";
  const double norm = object.heading.norm();
  if (!(norm == 0.0 || std::abs(norm - 1.0) <= kMaxHeadingError)) return "heading";
  if (!(std::abs(object.speed_mps) <= config.max_speed_mps)) return "speed";
  const double existence = object.existence_probability;
  if (!(existence == -1.0 || (existence >= 0.0 && existence <= 1.0))) return "existence";
  const bool lengths = plausible_length(object.position_stddev_m) && plausible_length(object.length_m) &&
                       plausible_length(object.width_m);
  return lengths ? std::string_view() : "length";
}

/// Whether two objects have one id.
bool has_doubles(const std::vector<TrackedObject>& objects) {
  std::vector<std::uint64_t> ids;
  ids.reserve(objects.size());
  for (const TrackedObject& object : objects) ids.push_back(object.id);
  std::ranges::sort(ids);
  return std::ranges::adjacent_find(ids) != ids.end();
}

}  // namespace

bool follows(const StreamPoint& point, const StreamPoint& before, const GateConfig& config,
             double max_step_s) {
  const double step_s = seconds(point.stamp_ns - before.stamp_ns);
  return before.session_id == point.session_id && step_s > 0.0 && step_s <= max_step_s &&
         (point.position - before.position).norm() <=
             config.max_pose_jump_m + config.max_speed_mps * step_s &&
         point.orientation.angularDistance(before.orientation) <=
             kDegree * (config.max_pose_turn_deg + config.max_turn_rate_degps * step_s);
}

Gate::Verdict Gate::check(const StreamPoint& point) {
  if (!last_) {
    last_ = point;
    return Verdict::accepted;
  }
  if (point.session_id != last_->session_id) {
    return is_superseded(point.session_id) ? check_outlier(point) : begin_anew(point);
  }
  const double step_s = seconds(point.stamp_ns - last_->stamp_ns);
  if (point.stamp_ns == last_->stamp_ns) return Verdict::repeated;
  if (step_s < 0.0 && step_s >= -config_.max_stamp_step_s) return check_late(point);
  const bool was_late = std::exchange(late_, {}).has_value();
  if (!plausible(*last_, point)) return check_outlier(point);
  if (!was_late) before_last_ = last_;
  last_ = point;
  outliers_in_a_row_ = 0;
  return Verdict::accepted;
}

bool Gate::plausible(const StreamPoint& from, const StreamPoint& to) const {
  return follows(to, from, config_, config_.max_stamp_step_s);
}

bool Gate::is_superseded(std::uint64_t session_id) const {
  return std::find(superseded_.begin(), superseded_.end(), session_id) != superseded_.end();
}

Gate::Verdict Gate::check_late(const StreamPoint& point) {
  if (!late_ || !plausible(*late_, point)) first_late_ = point;
  late_ = point;
  const bool lasts = seconds(point.stamp_ns - first_late_->stamp_ns) >= kLateToBelieve_s;
  if (!late_anew_ || !lasts) return Verdict::late;
  if (!before_last_ || !plausible(*before_last_, *first_late_)) return begin_anew(point);
  last_ = point;
  late_.reset();
  outliers_in_a_row_ = 0;
  return Verdict::corrects;
}

Gate::Verdict Gate::check_outlier(const StreamPoint& point) {
  const bool agrees = outliers_in_a_row_ > 0 && plausible(*outlier_, point);
  outliers_in_a_row_ = agrees ? outliers_in_a_row_ + 1 : 1;
  outlier_ = point;
  return outliers_in_a_row_ < kOutliersToBelieve ? Verdict::outlier : begin_anew(point);
}

Gate::Verdict Gate::begin_anew(const StreamPoint& point) {
  std::erase(superseded_, point.session_id);
  if (point.session_id != last_->session_id) superseded_.push_back(last_->session_id);
  if (superseded_.size() > kSessionsRemembered) superseded_.pop_front();
  last_ = point;
  before_last_.reset();
  late_.reset();
  outliers_in_a_row_ = 0;
  return Verdict::begins_anew;
}

std::string_view defect(const DetectionFrame& frame, const GateConfig& config) {
  if (!plausible_stamp(frame.stamp_ns)) return "stamp";
  if (!within(frame.field_of_view, config.max_coordinate_m)) return "coordinate";
  if (!frame.field_of_view.empty() && frame.field_of_view.size() < 3) return "too_few_points";
  for (const auto& area : frame.occluded_areas) {
    if (!within(area, config.max_coordinate_m)) return "coordinate";
  }
  for (const auto& detection : frame.detections) {
    if (const auto found = defect(detection, config); !found.empty()) return found;
  }
  return {};
}

std::string_view defect(const VehiclePose& pose, const GateConfig& config) {
  if (!plausible_stamp(pose.stamp_ns)) return "stamp";
  if (!within(pose.position, config.max_coordinate_m)) return "coordinate";
  return is_unit(pose.orientation) ? std::string_view() : "not_a_rotation";
}

std::string_view defect(const TrackedObjects& objects, const GateConfig& config) {
  if (!plausible_stamp(objects.stamp_ns)) return "stamp";
  for (const TrackedObject& object : objects.objects) {
    if (const auto found = defect(object, config); !found.empty()) return found;
  }
  return has_doubles(objects.objects) ? "repeated_id" : std::string_view();
}

std::string_view defect(const NextTurn& turn, const GateConfig& config) {
  if (!plausible_stamp(turn.stamp_ns)) return "stamp";
  const bool is_length = turn.distance_m >= 0.0 && turn.distance_m <= config.max_coordinate_m;
  return is_length ? std::string_view() : "distance";
}

}  // namespace laneloom::session
