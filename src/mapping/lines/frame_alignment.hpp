#pragma once

#include <Eigen/Core>
#include <vector>

#include "laneloom/types.hpp"
#include "mapping/lines/association.hpp"
#include "mapping/lines/line_map.hpp"

namespace laneloom {

/// What all detections of a frame have in common of their error: how far they lie ahead and to the left of
/// their places, in the body frame in metres, and how far they are turned about the vehicle, in radians.
using FrameError = Eigen::Vector3d;

/// How far the frame as a whole lies beside the lines that it was matched with, as far as these are reliable
/// and agree: robust, and drawn towards none where little tells.
FrameError estimate_error(const std::vector<LineMatch>& matches,
                          const std::vector<SampledDetection>& detections, const std::vector<Line>& lines,
                          const Eigen::Isometry3d& T_map_body, double min_log_odds);

/// How far a place of the map lies beside where it would without that error, horizontally.
Eigen::Vector2d shifted_by(const FrameError& error, const Point& point, const Eigen::Isometry3d& T_map_body);

/// Takes the share `gain` of a frame's error out of its detections, but for what lasts: that is a drift of
/// the poses, with which the map has to go. `lasting` is its running mean. Returns the error without it.
/// `matcher` is of the map's lines. Ours.
FrameError align_frame(const Eigen::Isometry3d& T_map_body, double gain, LineMatcher& matcher,
                       std::vector<SampledDetection>& detections, FrameError& lasting);

}  // namespace laneloom
