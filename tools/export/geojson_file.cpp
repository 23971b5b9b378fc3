#include "export/geojson_file.hpp"

#include <GeographicLib/LocalCartesian.hpp>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "io/json_fields.hpp"
#include "io/text_file.hpp"
#include "laneloom/element_names.hpp"

namespace laneloom::exports {
namespace {

using nlohmann::json;
using Way = RoadNetwork::Way;

double rounded(double value, double steps) { return std::round(value * steps) / steps; }

json or_null(double value) { return value < 0.0 ? json() : json(rounded(value, 1e3)); }

class Geometry {
 public:
  Geometry(const RoadNetwork& network, const Origin& origin)
      : network_(network), earth_(origin.latitude_deg, origin.longitude_deg, 0.0) {}

  json line(const Way& way) const {
    json positions = json::array();
    for (const std::size_t node : way.nodes) positions.push_back(position(network_.nodes[node]));
    return {{"type", "LineString"}, {"coordinates", positions}};
  }
  /// The outline of a lanelet, counter-clockwise: along the right side, and back along the left one.
  json area(const RoadNetwork::Lanelet& lanelet) const {
    Polyline ring = points(lanelet.right);
    const Polyline left = points(lanelet.left);
    ring.insert(ring.end(), left.rbegin(), left.rend());
    json positions = json::array();
    for (const Point& point : ring) positions.push_back(position(point));
    positions.push_back(positions.front());
    return {{"type", "Polygon"}, {"coordinates", json::array({positions})}};
  }

 private:
  json position(const Point& point) const {
    double latitude_deg = 0.0, longitude_deg = 0.0, height_m = 0.0;
    earth_.Reverse(point.x(), point.y(), point.z(), latitude_deg, longitude_deg, height_m);
    return {rounded(longitude_deg, 1e8), rounded(latitude_deg, 1e8), rounded(point.z(), 1e3)};
  }
  Polyline points(const RoadNetwork::Side& side) const {
    Polyline points;
    for (const std::size_t node : network_.ways[side.way].nodes) points.push_back(network_.nodes[node]);
    if (side.reversed) std::ranges::reverse(points);
    return points;
  }

  const RoadNetwork& network_;
  GeographicLib::LocalCartesian earth_;
};

json style_of(const Way& way) { return way.style == MarkingStyle::unknown ? json() : json(name(way.style)); }

const char* kind_of(const Way& way) {
  switch (way.kind) {
    case Way::Kind::laneline:
      return "laneline";
    case Way::Kind::roadedge:
      return "roadedge";
    case Way::Kind::stopline:
      return "stopline";
    case Way::Kind::virtual_line:
      break;
  }
  return "virtual";
}

json turn_of(const RoadNetwork::Lanelet& lanelet) {
  return lanelet.turn == Linkage::Turn::unknown ? json() : json(name(lanelet.turn));
}

json feature(json geometry, json properties) {
  return {{"type", "Feature"}, {"geometry", std::move(geometry)}, {"properties", std::move(properties)}};
}

}  // namespace

void write_geojson(const std::filesystem::path& path, const RoadNetwork& network, const Origin& origin) {
  const Geometry geometry(network, origin);
  json features = json::array();
  for (const Way& way : network.ways)
    features.push_back(feature(geometry.line(way), {{"kind", kind_of(way)},
                                                    {"style", style_of(way)},
                                                    {"existence", or_null(way.existence_probability)},
                                                    {"stddev_m", or_null(way.lateral_stddev_m)}}));
  for (const RoadNetwork::Lanelet& lanelet : network.lanelets)
    features.push_back(
        feature(geometry.area(lanelet), {{"kind", lanelet.linkage ? "linkage" : "lane"},
                                         {"one_way", lanelet.one_way},
                                         {"turn", turn_of(lanelet)},
                                         {"existence", or_null(lanelet.existence_probability)}}));
  io::write_text(path, json{{"type", "FeatureCollection"}, {"features", features}}.dump() + "\n");
}

}  // namespace laneloom::exports
