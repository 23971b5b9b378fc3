#include "check/agreement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/degree.hpp"
#include "base/distribution.hpp"
#include "laneloom/polyline.hpp"

namespace laneloom::check {
namespace {

constexpr double kMostAnchors = 120.0;
constexpr double kTurnMetres = 60.0;                   // a turn by 1 rad tells as much as so many metres
constexpr std::int64_t kMostShift_ns = 1'000'000'000;  // of the poses
constexpr std::array kSteps_m{5.0, 12.0, 20.0};        // between the frames of a pair, along the way
constexpr std::size_t kLinePoints = 16;
constexpr std::size_t kFewestPoints = 6;
constexpr double kFarthest_m = 1.0;  // that a distance counts
constexpr double kMargin_m = 0.9;    // by which a view reaches beyond its points: their ends are near enough
constexpr double kNearby_m = 25.0, kLeastReach_m = 3.0;  // of the nearest and of the farthest point
constexpr double kMostAcross = 2.0;  // of lines: a crossing street's, per metre along the way
constexpr double kMostTilt_deg = 30.0, kMostHeading_deg = 60.0;

/// A line with points between its own, so that each of its parts has some.
Polyline with_points_between(const Polyline& line) {
  const std::size_t parts = 1 + (kLinePoints - 1) / (line.size() - 1);
  Polyline result{line.front()};
  for (std::size_t i = 1; i < line.size(); ++i)
    for (std::size_t part = 1; part <= parts; ++part)
      result.emplace_back(line[i - 1] +
                          (line[i] - line[i - 1]) * static_cast<double>(part) / static_cast<double>(parts));
  return result;
}

/// A frame, how far the vehicle has driven there, and how much there was to tell by until there.
struct Place {
  double driven_m = 0.0, told_m = 0.0;
  std::size_t frame = 0;
};

/// The places of the frames that see something. They keep away from the ends of the poses, so that poses can
/// be shifted.
std::vector<Place> places(const std::vector<DetectionFrame>& frames, const PoseTrack& poses,
                          double pose_scale) {
  std::vector<Place> result;
  std::optional<Point> last;
  Eigen::Vector2d course = Eigen::Vector2d::Zero();  // of the last metres
  double driven_m = 0.0, told_m = 0.0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::int64_t stamp_ns = frames[i].stamp_ns;
    const auto pose = poses.at(stamp_ns, {.pose_scale = pose_scale});
    if (!pose || !poses.at(stamp_ns - kMostShift_ns, {}) || !poses.at(stamp_ns + kMostShift_ns, {})) continue;
    const Eigen::Vector2d step = (pose->translation() - last.value_or(pose->translation())).head<2>();
    last = pose->translation();
    driven_m += step.norm();
    told_m += step.norm() + kTurnMetres * std::abs(std::atan2(cross(course, step), course.dot(step)));
    if (!step.isZero()) course = step;
    if (!frames[i].detections.empty()) result.push_back({driven_m, told_m, i});
  }
  return result;
}

double angle_deg(const Point& a, const Point& b) { return std::atan2(a.cross(b).norm(), a.dot(b)) / kDegree; }

double median(const std::vector<double>& values) { return Distribution(values).quantile(0.5); }

}  // namespace

Agreement::Agreement(const std::vector<DetectionFrame>& frames, const PoseTrack& poses, double pose_scale)
    : poses_(poses) {
  const std::vector<Place> all = places(frames, poses, pose_scale);
  if (all.empty()) return;
  turned_deg_ = (all.back().told_m - all.back().driven_m) / kTurnMetres / kDegree;
  const auto add_view = [&](std::size_t frame) {
    View& view = views_.emplace_back(View{frames[frame].stamp_ns, frames[frame].detections});
    for (Detection& line : view.lines) line.points = with_points_between(line.points);
    return views_.size() - 1;
  };
  const double apart_m = std::max(1.0, all.back().told_m / kMostAnchors);
  for (auto anchor = all.begin(); anchor != all.end();
       anchor = std::ranges::lower_bound(anchor, all.end(), anchor->told_m + apart_m, {}, &Place::told_m)) {
    const std::size_t from = add_view(anchor->frame);
    for (const double step_m : kSteps_m) {
      const auto partner =
          std::ranges::lower_bound(anchor, all.end(), anchor->driven_m + step_m, {}, &Place::driven_m);
      if (partner == all.end() || partner->driven_m > anchor->driven_m + 2.0 * step_m) continue;
      pairs_.emplace_back(from, add_view(partner->frame));
    }
  }
}

std::vector<double> Agreement::disagreements(const Correction& correction) const {
  std::vector<std::optional<Outline>> outlines;
  outlines.reserve(views_.size());
  for (const View& view : views_) outlines.push_back(outline(view, correction));
  std::vector<double> result;
  result.reserve(pairs_.size());
  for (const auto& [from, to] : pairs_)
    result.push_back(outlines[from] && outlines[to] ? disagreement(*outlines[from], *outlines[to])
                                                    : kFarthest_m);
  return result;
}

std::optional<Agreement::Outline> Agreement::outline(const View& view, const Correction& correction) const {
  const auto pose = poses_.at(view.stamp_ns, correction);
  if (!pose) return std::nullopt;
  Outline result;
  result.T_map_body = *pose;
  const Eigen::Affine3d T_body_points = body_from_points(correction, *pose);
  for (const Detection& line : view.lines) {
    Line& seen = result.lines[line.type == MarkingType::stopline ? 1 : 0].emplace_back(Line{line.points, {}});
    for (Point& point : seen.points) {
      point = T_body_points * point;
      seen.bounds.extend(point.head<2>());
    }
    result.bounds.extend(seen.bounds);
  }
  return result;
}

/// The horizontal distance of a point from the nearest line, or kFarthest_m. Empty: a line's end is nearest.
/// How far the point lies beyond it depends on what the frames see of the line.
std::optional<double> Agreement::distance(const Eigen::Vector2d& point, const std::vector<Line>& lines) {
  double nearest2 = kFarthest_m * kFarthest_m;
  bool is_beyond_end = false;
  for (const Line& line : lines) {
    if (line.bounds.squaredExteriorDistance(point) >= nearest2) continue;
    for (std::size_t i = 1; i < line.points.size(); ++i) {
      const Eigen::Vector2d along = (line.points[i] - line.points[i - 1]).head<2>();
      const Eigen::Vector2d beyond = point - line.points[i - 1].head<2>();
      const double length2 = along.squaredNorm();
      const double at = length2 > 0.0 ? along.dot(beyond) / length2 : 0.0;
      const double distance2 = (beyond - std::clamp(at, 0.0, 1.0) * along).squaredNorm();
      if (distance2 >= nearest2) continue;
      nearest2 = distance2;
      is_beyond_end = (i == 1 && at < 0.0) || (i + 1 == line.points.size() && at > 1.0);
    }
  }
  return is_beyond_end ? std::nullopt : std::optional(std::sqrt(nearest2));
}

double Agreement::disagreement(const Outline& from, const Outline& to) {
  const Eigen::Isometry3d T_to_from = to.T_map_body.inverse() * from.T_map_body;
  const Eigen::AlignedBox2d view(to.bounds.min().array() - kMargin_m, to.bounds.max().array() + kMargin_m);
  double sum_m = 0.0;
  std::size_t count = 0;
  for (std::size_t kind = 0; kind < from.lines.size(); ++kind)
    for (const Line& line : from.lines[kind])
      for (const Point& point : line.points) {
        const Eigen::Vector2d there = (T_to_from * point).head<2>();
        if (!view.contains(there)) continue;
        const std::optional<double> distance_m = distance(there, to.lines[kind]);
        if (!distance_m) continue;
        sum_m += *distance_m;
        ++count;
      }
  return count < kFewestPoints ? kFarthest_m : sum_m / static_cast<double>(count);
}

bool Agreement::drives_forward(const Correction& correction) const {
  std::vector<double> tilts_deg, headings_deg;
  for (const auto& [from, to] : pairs_) {
    const auto here = poses_.at(views_[from].stamp_ns, correction);
    const auto there = poses_.at(views_[to].stamp_ns, correction);
    if (!here || !there) continue;
    tilts_deg.push_back(angle_deg(here->linear().col(2), Point::UnitZ()));
    headings_deg.push_back(angle_deg(here->linear().col(0) + there->linear().col(0),
                                     there->translation() - here->translation()));
  }
  return median(tilts_deg) < kMostTilt_deg && median(headings_deg) < kMostHeading_deg;
}

bool Agreement::lines_lie_well(const Correction& correction) const {
  std::vector<double> nearest_m, farthest_m;
  double along_m = 0.0, across_m = 0.0, upward_m = 0.0;
  for (const View& view : views_) {
    const std::optional<Outline> seen = outline(view, correction);
    if (!seen || seen->lines[0].empty()) continue;
    double nearest = std::numeric_limits<double>::infinity(), farthest = 0.0;
    for (const auto& [points, bounds] : seen->lines[0])
      for (std::size_t i = 1; i < points.size(); ++i) {
        const Point step = (points[i] - points[i - 1]).cwiseAbs();
        along_m += step.x();
        across_m += step.y();
        upward_m += step.z();
        const double away_m = points[i].head<2>().norm();
        nearest = std::min(nearest, away_m);
        farthest = std::max(farthest, away_m);
      }
    nearest_m.push_back(nearest);
    farthest_m.push_back(farthest);
  }
  return Distribution(nearest_m).quantile(0.8) < kNearby_m && median(farthest_m) > kLeastReach_m &&
         across_m < kMostAcross * along_m && upward_m < along_m;
}

double Agreement::size() const {
  Distribution sizes;
  for (const View& view : views_) {
    double nearest = std::numeric_limits<double>::infinity(), farthest = 0.0;
    for (const Detection& line : view.lines)
      for (const Point& point : line.points) {
        nearest = std::min(nearest, point.norm());
        farthest = std::max(farthest, point.norm());
      }
    sizes.add(std::sqrt(nearest * farthest));
  }
  return sizes.quantile(0.5);
}

}  // namespace laneloom::check
