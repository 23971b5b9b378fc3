#pragma once

#include <filesystem>

#include "export/origin.hpp"
#include "export/road_network.hpp"

namespace laneloom::exports {

/// Writes the ways and lanelets as GeoJSON (RFC 7946): a FeatureCollection in WGS84, longitude first, 8
/// decimals, height in metres. A way is a LineString with `kind`, `style`, `existence` and `stddev_m`; a
/// lanelet is a Polygon with `kind` lane or linkage, `one_way`, `turn` and `existence`. Unknown values are
/// null.
///
/// Throws std::runtime_error naming the file if it cannot be written.
void write_geojson(const std::filesystem::path& path, const RoadNetwork& network, const Origin& origin);

}  // namespace laneloom::exports
