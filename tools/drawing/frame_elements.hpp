#pragma once

#include "drawing/drawing.hpp"
#include "laneloom/config.hpp"
#include "laneloom/types.hpp"

/// What of a frame, of the vehicle and around it can be drawn. Pure functions but for the drawing.
namespace laneloom {

/// The detections: what is sure is opaque. `T_map_body` is the pose at the frame's stamp.
void add_detections(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body, Drawing& drawing);
/// The field of view and the occluded areas, where the frame gives them.
void add_view(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body, Drawing& drawing);

/// A car of usual size, the body frame's origin below its rear axle.
void add_vehicle(const Eigen::Isometry3d& T_map_body, Drawing& drawing);
/// The box around the vehicle that a map is kept in.
void add_range(const RangeConfig& range, const Eigen::Isometry3d& T_map_body, Drawing& drawing);

}  // namespace laneloom
