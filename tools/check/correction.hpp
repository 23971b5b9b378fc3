#pragma once

#include <cstdint>
#include <string>

#include "laneloom/next_turn.hpp"
#include "laneloom/objects.hpp"
#include "laneloom/types.hpp"

namespace laneloom::check {

/// How confidences are written: from 0 to 1, from 0 to 100, or as log odds.
enum class ConfidenceScale : std::uint8_t { share, percent, logit };

/// What makes a drive in conventions of others one in those of laneloom. By default nothing is changed.
struct Correction {
  std::string axes = "forward-left";  ///< of the points, see io::axes_named()
  double point_scale = 1.0;           ///< metres per unit of the points
  bool points_in_map = false;         ///< the points are in the map frame, instead of the body frame
  double sensor_left_m = 0.0;         ///< place of the points' frame in the body frame
  double sensor_yaw_deg = 0.0;        ///< its turn to the left in the body frame
  double pose_scale = 1.0;            ///< metres per unit of the positions
  bool scalar_first = false;          ///< orientations are written as w, x, y, z
  double pose_time_s = 0.0;           ///< is added to the stamps of poses
  ConfidenceScale confidences = ConfidenceScale::share;
};

/// The correction as options of `laneloom import frames`. Empty: nothing is changed.
std::string options(const Correction& correction);

/// A pose as it is meant. Its orientation is of unit length if the given one is.
VehiclePose corrected(VehiclePose pose, const Correction& correction);

/// Takes points to the body frame. `T_map_body` is the corrected pose at their stamp.
Eigen::Affine3d body_from_points(const Correction& correction, const Eigen::Isometry3d& T_map_body);

/// A frame as it is meant, with all of its points in the body frame.
DetectionFrame corrected(DetectionFrame frame, const Correction& correction,
                         const Eigen::Isometry3d& T_map_body);

/// Objects as they are meant, in the body frame. They are in the frame and the unit of the points. Those
/// that are said to be in the map frame are taken from there.
TrackedObjects corrected(TrackedObjects objects, Correction correction, const Eigen::Isometry3d& T_map_body);
/// A turn has no coordinates.
inline NextTurn corrected(const NextTurn& turn, const Correction& /*correction*/,
                          const Eigen::Isometry3d& /*T_map_body*/) {
  return turn;
}

}  // namespace laneloom::check
