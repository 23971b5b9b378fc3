#pragma once

#include <filesystem>

#include "export/origin.hpp"
#include "export/road_network.hpp"

namespace laneloom {

/// Writes a Lanelet2 map (.osm) as Autoware reads it: nodes have local_x, local_y and ele in metres, and
/// latitude and longitude by the origin. Lanelets are roads for vehicles; those of linkages across
/// intersections have a turn_direction, a u-turn being one to the side that it goes round. Stop lines are
/// regulatory elements of the type road_marking. What is known of a line or lane beyond Lanelet2 is in tags
/// laneloom:existence, laneloom:stddev_m and laneloom:status.
///
/// Throws std::runtime_error naming the file where it cannot be written.
void write_lanelet2(const std::filesystem::path& path, const RoadNetwork& network, const Origin& origin);

}  // namespace laneloom
