#pragma once

#include <filesystem>

#include "export/origin.hpp"
#include "export/road_network.hpp"

namespace laneloom::exports {

/// Writes the ways and lanelets as GeoJSON (RFC 7946): a FeatureCollection in WGS84, longitude first, 8
/// decimals, height in metres. Each feature has an `id` that no other has. Unknown values are null.
/// - A way is a LineString with `kind`, `style`, `existence` and `stddev_m`.
/// - A lanelet is a Polygon with `kind` lane or linkage, `one_way`, `turn` and `existence`, `lane` (the id of
///   the map's lane), and the ids of its `left` and `right` way, of its `centreline`, and of the lanelets
///   that continue it (`successors`).
/// - A centreline is a LineString with `kind` and the id of its `lanelet`, in driving direction.
///
/// Throws std::runtime_error naming the file if it cannot be written.
void write_geojson(const std::filesystem::path& path, const RoadNetwork& network, const Origin& origin);

}  // namespace laneloom::exports
