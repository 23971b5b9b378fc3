#pragma once

#include "drawing/drawing.hpp"
#include "laneloom/config.hpp"
#include "laneloom/types.hpp"

/// Adds a frame, the vehicle, and the box around it to a drawing. The functions change nothing but the
/// drawing.
namespace laneloom::drawing {

/// Adds the detections, the surer the more opaque. `T_map_body` is the pose at the frame's stamp.
void add_detections(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body, Drawing& drawing);
/// Adds the field of view and the occluded areas, if the frame gives them.
void add_view(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body, Drawing& drawing);

/// Adds a car of usual size. The body frame's origin is below its rear axle.
void add_vehicle(const Eigen::Isometry3d& T_map_body, Drawing& drawing);
/// Adds the box around the vehicle that is mapped.
void add_range(const RangeConfig& range, const Eigen::Isometry3d& T_map_body, Drawing& drawing);

}  // namespace laneloom::drawing
