#pragma once

#include <filesystem>

#include "export/road_network.hpp"

namespace laneloom::exports {

/// Writes a network as OpenDRIVE 1.7 (.xodr), in metres of the map frame; "-" is standard output.
///
/// Lanelets beside each other that are driven in one direction are a road with the lanes -1, -2, … Its
/// reference line is the left border, as paramPoly3. Lanes have widths and road marks, roads have elevations.
/// Lanelets of linkages are connecting roads of junctions; roads of which one follows the other alone are
/// linked. Other joints have no links: there, roads only meet. A stop line is an object (roadMark,
/// signalLines) of the road that ends at it. Throws std::runtime_error if the file cannot be written.
void write_opendrive(const std::filesystem::path& path, const RoadNetwork& network);

}  // namespace laneloom::exports
