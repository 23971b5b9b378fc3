#pragma once

#include <filesystem>

#include "export/origin.hpp"
#include "export/road_network.hpp"

namespace laneloom::exports {

/// Writes a Lanelet2 map (.osm) as Autoware reads it. Nodes have local_x, local_y and ele in metres, and
/// latitude and longitude by the origin. Lanelets are roads for vehicles. Lanelets of linkages across
/// intersections have a turn_direction; that of a u-turn is the side to which it bends. Stop lines are
/// regulatory elements of the type road_marking. Further knowledge of lines and lanes is in the tags
/// laneloom:existence, laneloom:stddev_m and laneloom:status.
/// Without `extras`, the tags that only Autoware and laneloom know are left out: local_x, local_y,
/// turn_direction, and laneloom's.
///
/// Throws std::runtime_error naming the file if it cannot be written.
void write_lanelet2(const std::filesystem::path& path, const RoadNetwork& network, const Origin& origin,
                    bool extras = true);

}  // namespace laneloom::exports
