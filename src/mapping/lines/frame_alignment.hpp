#pragma once

#include <Eigen/Core>
#include <vector>

#include "laneloom/types.hpp"
#include "mapping/lines/association.hpp"
#include "mapping/lines/line_map.hpp"

namespace laneloom::lines {

/// The error that all detections of a frame have in common, in the body frame: metres ahead and to the left
/// of their true places, and radians by which they are turned about the vehicle.
using FrameError = Eigen::Vector3d;

/// Two estimates of one error.
struct FrameErrors {
  FrameError likely;  ///< of a frame as networks make them: they seldom err to one side all over
  FrameError away;    ///< of poses that come away from the map, to any side
};

/// Estimates the error of a frame from the lines that it was matched with. Only stations with log odds of at
/// least `min_log_odds` count. Lines that disagree with the others weigh little. With little evidence the
/// estimates stay near zero.
FrameErrors estimate_errors(const std::vector<LineMatch>& matches,
                            const std::vector<SampledDetection>& detections, const std::vector<Line>& lines,
                            const Eigen::Isometry3d& T_map_body, double min_log_odds);

/// The horizontal offset, map frame, by which that error moves a place of the map.
Eigen::Vector2d shifted_by(const FrameError& error, const Point& point, const Eigen::Isometry3d& T_map_body);

/// Takes the share `gain` of a frame's likely error out of its detections. The part of the error that lasts
/// is left in: it is a drift of the poses, with which the map has to go. `lasting` is its running mean.
/// Returns the errors, the likely one without the lasting part. `matcher` holds the map's lines. Ours.
FrameErrors align_frame(const Eigen::Isometry3d& T_map_body, double gain, LineMatcher& matcher,
                        std::vector<SampledDetection>& detections, FrameError& lasting);

}  // namespace laneloom::lines
