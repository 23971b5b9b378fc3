#pragma once

#include <filesystem>

#include "base/left_out.hpp"
#include "simulation/road.hpp"

namespace laneloom::simulation {

/// Loads a Lanelet2 map (.osm) and drives a long way along its lanes, at constant speed.
///
/// Coordinates are the nodes' local_x and local_y if most nodes have them, or else metres east and north of
/// the first node. The height is ele, or 0 if that is absent or no number. Lanelines are line_thin and
/// line_thick, roadedges are curbstone, road_border, wall, fence and guard_rail, and stoplines are stop_line.
/// Virtual lines and lines without a type are no markings. Lanes are the lanelets for vehicles, with borders
/// oriented as Lanelet2 does: those with a tag participant:vehicle that is yes; where no participant is
/// named, those whose subtype is road, highway, bus_lane, play_street, emergency_lane or exit, and those
/// without a subtype. A lanelet that may be driven both ways counts in the direction in which it is drawn. A
/// lane is in an intersection if it has a turn_direction, or both borders are virtual. Traffic is left-hand
/// if opposite lanes share their right borders more often than their left ones. Where none share a border, it
/// is left-hand if opposite lanes lie to the right within 6 m more often than to the left. The way is the
/// longest one found, where lanes without a laneline count little.
///
/// Elements that an editor marked as deleted are passed over. What is wrong is left out, with what hangs on
/// it: a node without a place, a way with a node that is not there, a lane with a border that is not there,
/// an element that comes twice, what follows the place where the file is damaged. Throws std::runtime_error
/// naming the file if there are no lanes, or neither lanelines nor roadedges; also naming the first wrong
/// element if `left_out` is strict.
Road load_lanelet2(const std::filesystem::path& osm_file, double speed_mps, LeftOut& left_out);

/// Does so strictly.
inline Road load_lanelet2(const std::filesystem::path& osm_file, double speed_mps = 10.0) {
  LeftOut nothing(/*strict=*/true);
  return load_lanelet2(osm_file, speed_mps, nothing);
}

}  // namespace laneloom::simulation
