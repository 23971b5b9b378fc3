#pragma once

#include <filesystem>

#include "simulation/road.hpp"

namespace laneloom {

/// Loads a Lanelet2 map (.osm) and drives a long way along its lanes, at constant speed.
///
/// Coordinates are the nodes' local_x and local_y where all nodes have them, else metres east and north of
/// the first node; the height is ele, or 0. Lanelines are line_thin and line_thick, roadedges are curbstone,
/// road_border, wall, fence and guard_rail, stoplines are stop_line; a virtual line is no marking, nor is one
/// without type. Lanes are the lanelets for vehicles, with borders oriented as Lanelet2 does; one that may be
/// driven both ways counts in the direction that it is drawn in. A lane is in an intersection where it says a
/// turn_direction, or both borders are virtual. Traffic is left-hand where opposite lanes share their right
/// borders more often than their left ones, and at least every tenth does. The way is the longest found,
/// where lanes without a laneline count little.
///
/// Throws std::runtime_error naming file and element.
Road load_lanelet2(const std::filesystem::path& osm_file, double speed_mps = 10.0);

}  // namespace laneloom
