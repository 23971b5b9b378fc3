#pragma once

#include "laneloom/sd_map.hpp"
#include "laneloom/way_types.hpp"

namespace laneloom::topology {

/// Lets a way go on from its end as the street of the SD map does. The street tells the shape alone: its line
/// is laid onto the last 30 m of the way, and of the places `driven` before (map frame), and goes on from the
/// way's end, for at most 30 m. How well it fits tells how fast the lateral standard deviation grows; the way
/// ends where that is 1.75 m. New stations have a place, a deviation and a status alone. Returns whether
/// there are new ones. Ours.
bool go_on_along_street(const SdMap& sd_map, const Polyline& driven, Way& way);

}  // namespace laneloom::topology
