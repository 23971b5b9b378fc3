#pragma once

#include <vector>

#include "drawing/drawing.hpp"
#include "laneloom/objects.hpp"
#include "laneloom/types.hpp"
#include "mapping/trails/trails.hpp"

/// Adds other vehicles to a drawing. The functions change nothing but the drawing.
namespace laneloom::drawing {

/// Adds the boxes of what a tracker follows. `T_map_body` is the pose at the message's stamp. What has no
/// known size gets a usual one.
void add_objects(const TrackedObjects& objects, const Eigen::Isometry3d& T_map_body, Drawing& drawing);

/// Adds the trails, each with the lanes of the map that it tells the direction of, and arrows on the lanes
/// whose direction was told by trails.
void add_trails(const std::vector<trails::Trail>& trails, const LocalMap& map, Drawing& drawing);

}  // namespace laneloom::drawing
