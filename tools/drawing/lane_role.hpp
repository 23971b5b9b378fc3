#pragma once

#include <cstdint>

#include "laneloom/types.hpp"

namespace laneloom::drawing {

/// The meaning of a lane for the vehicle. Colours of lanes tell it.
enum class LaneRole : std::uint8_t {
  own,       ///< the vehicle drives in it
  same_way,  ///< its traffic runs as the vehicle drives
  oncoming,  ///< its traffic runs against the vehicle, or either way
  crossing,  ///< its traffic crosses the vehicle's way
  unknown,   ///< the direction of its traffic is not known
  unused     ///< a strip at the side of the road
};

/// `own` is the id of the lane that the vehicle drives in; kNoElement: it drives in none. Directions are
/// compared where the lane is nearest to the vehicle.
LaneRole role_of(const Lane& lane, ElementId own, const Eigen::Isometry3d& T_map_body);

/// The id of the lane that the vehicle drives in. kNoElement: it drives in none.
ElementId own_lane_of(const LocalMap& map);

/// The role for people: "own lane".
const char* title(LaneRole role);

}  // namespace laneloom::drawing
