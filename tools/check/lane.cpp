#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "base/distribution.hpp"
#include "check/findings.hpp"

namespace laneloom::check {
namespace {

constexpr std::array kAhead_m{2.0, 6.0, 10.0};
constexpr std::size_t kFewestFrames = 30;                     // that must show the lane
constexpr double kLeastOffset_m = 0.35, kMostSpread_m = 0.5;  // of the vehicle from the middle
constexpr double kLeastConfidence = 1.0 / 3.0;                // of the frame's median
constexpr double kBeyondLimit_m = 1.3;  // up to there beyond the greatest width, the own lane is still found
constexpr double kRoom = 0.85;          // from a measured width to a limit below it

/// Left and right line of the vehicle's lane, as their lateral distances.
struct OwnLane {
  double right_m = -std::numeric_limits<double>::infinity(), left_m = std::numeric_limits<double>::infinity();
  double width() const { return left_m - right_m; }
  double middle() const { return 0.5 * (left_m + right_m); }
  bool found() const { return std::isfinite(left_m) && std::isfinite(right_m); }
};

/// The confidence from which on a line counts. Some networks write all that they doubt.
double least_confidence(const DetectionFrame& frame) {
  Distribution confidences;
  for (const Detection& line : frame.detections) confidences.add(line.confidence);
  return kLeastConfidence * confidences.quantile(0.5);
}

OwnLane own_lane_at(const DetectionFrame& frame, double ahead_m, bool between_edges) {
  OwnLane lane;
  const double least = least_confidence(frame);
  for (const Detection& line : frame.detections) {
    const bool counts = line.confidence >= least && (line.type == MarkingType::laneline ||
                                                     (between_edges && line.type == MarkingType::roadedge));
    for (std::size_t i = 1; counts && i < line.points.size(); ++i) {
      const Point &from = line.points[i - 1], &to = line.points[i];
      if ((from.x() <= ahead_m) == (to.x() <= ahead_m)) continue;
      const double share = (ahead_m - from.x()) / (to.x() - from.x());
      const double y = from.y() + share * (to.y() - from.y());
      (y > 0.0 ? lane.left_m : lane.right_m) = y > 0.0 ? std::min(lane.left_m, y) : std::max(lane.right_m, y);
    }
  }
  return lane;
}

std::optional<OwnLane> own_lane(const DetectionFrame& frame, bool between_edges) {
  for (const double ahead_m : kAhead_m)
    if (const OwnLane lane = own_lane_at(frame, ahead_m, between_edges); lane.found()) return lane;
  return std::nullopt;
}

/// `between_lines_m` are of the lanes without an edge. Three quarters of the frames have to agree: a line
/// that is not seen makes a lane look wide.
Findings width_findings(const Distribution& widths_m, const Distribution& between_lines_m,
                        const LaneConfig& lane) {
  const double width_m = widths_m.quantile(0.75), wide_m = between_lines_m.quantile(0.25);
  if (widths_m.count() >= kFewestFrames && width_m < lane.min_width_m)
    return {{"lane_narrow",
             fmt::format("The vehicle's lane is {:.1f} m wide; lanes are found from {:g} m on.", width_m,
                         lane.min_width_m),
             fmt::format("Set mapper.lane.min_width_m to {:.1f}, and mapper.lane.assumed_width_m to {:.1f}.",
                         kRoom * width_m, width_m)}};
  if (between_lines_m.count() >= kFewestFrames && wide_m > lane.max_width_m + kBeyondLimit_m)
    return {
        {"lane_wide",
         fmt::format("The vehicle's lane is {:.1f} m wide; lanes between two lines are found up to {:g} m.",
                     wide_m, lane.max_width_m + kBeyondLimit_m),
         fmt::format("Set mapper.lane.max_width_m to {:.1f}.", wide_m / kRoom)}};
  return {};
}

/// A vehicle that keeps to one side of its lane.
Findings offset_findings(const Distribution& middles_m, Correction& correction) {
  const double middle_m = middles_m.quantile(0.5);
  const double spread_m = middles_m.quantile(0.75) - middles_m.quantile(0.25);
  if (middles_m.count() < kFewestFrames || correction.sensor_left_m != 0.0 ||
      std::abs(middle_m) < kLeastOffset_m || spread_m > kMostSpread_m)
    return {};
  correction.sensor_left_m = -middle_m;
  return {
      {"sensor_left",
       fmt::format(
           "The middle of the vehicle's lane lies {:.2f} m to the {} of the vehicle: the points are too far "
           "there, or the driver keeps off the middle.",
           std::abs(middle_m), middle_m > 0.0 ? "left" : "right"),
       {}}};
}

}  // namespace

Findings lane_findings(const std::vector<DetectionFrame>& frames, const PoseTrack& poses,
                       const LaneConfig& lane, Correction& correction) {
  Distribution widths_m, between_lines_m, middles_m;
  for (const DetectionFrame& frame : frames) {
    const auto pose = poses.at(frame.stamp_ns, correction);
    if (!pose) continue;
    const DetectionFrame right = corrected(frame, correction, *pose);
    if (const auto own = own_lane(right, false)) between_lines_m.add(own->width());
    const auto own = own_lane(right, true);
    if (!own) continue;
    widths_m.add(own->width());
    if (own->width() >= lane.min_width_m && own->width() <= lane.max_width_m) middles_m.add(own->middle());
  }
  Findings found = width_findings(widths_m, between_lines_m, lane);
  if (found.empty()) found = offset_findings(middles_m, correction);
  return found;
}

}  // namespace laneloom::check
