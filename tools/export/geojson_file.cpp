#include "export/geojson_file.hpp"

#include <GeographicLib/LocalCartesian.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "io/json_fields.hpp"
#include "io/text_file.hpp"
#include "laneloom/element_names.hpp"
#include "laneloom/polyline.hpp"

namespace laneloom::exports {
namespace {

using nlohmann::json;
using Way = RoadNetwork::Way;

double rounded(double value, double steps) { return std::round(value * steps) / steps + 0.0; }  // no -0

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

  /// The line halfway between the sides, with a position a metre.
  json centreline(const RoadNetwork::Lanelet& lanelet) const {
    const MeasuredPolyline left(points(lanelet.left)), right(points(lanelet.right));
    const double steps = std::max(1.0, std::ceil(0.5 * (left.length() + right.length())));
    json positions = json::array();
    for (double step = 0.0; step <= steps; step += 1.0)
      positions.push_back(
          position(0.5 * (left.at(step / steps * left.length()) + right.at(step / steps * right.length()))));
    return {{"type", "LineString"}, {"coordinates", positions}};
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

json feature(std::string id, json geometry, json properties) {
  return {{"type", "Feature"},
          {"id", std::move(id)},
          {"geometry", std::move(geometry)},
          {"properties", std::move(properties)}};
}

std::string id_of(const char* kind, std::size_t index) {
  return std::string(kind) + "/" + std::to_string(index);
}

/// The lanelets that begin where others end, by the nodes of their ends.
class Successions {
 public:
  explicit Successions(const RoadNetwork& network) : network_(network) {
    for (std::size_t i = 0; i < network.lanelets.size(); ++i)
      beginnings_.emplace(ends(network.lanelets[i], false), i);
  }

  json successors(const RoadNetwork::Lanelet& lanelet) const {
    json ids = json::array();
    const auto [first, last] = beginnings_.equal_range(ends(lanelet, true));
    for (auto next = first; next != last; ++next) ids.push_back(id_of("lanelet", next->second));
    return ids;
  }

 private:
  using Ends = std::pair<std::size_t, std::size_t>;
  Ends ends(const RoadNetwork::Lanelet& lanelet, bool at_back) const {
    return {end_node(network_, lanelet.left, at_back), end_node(network_, lanelet.right, at_back)};
  }

  const RoadNetwork& network_;
  std::multimap<Ends, std::size_t> beginnings_;
};

const char* kind_of(const RoadNetwork::Lanelet& lanelet) {
  if (lanelet.is_side_strip()) return name(lanelet.use);
  return lanelet.linkage ? "linkage" : "lane";
}

json properties_of(const RoadNetwork::Lanelet& lanelet, std::size_t index, const Successions& successions) {
  return {{"kind", kind_of(lanelet)},
          {"one_way", lanelet.one_way},
          {"turn", turn_of(lanelet)},
          {"existence", or_null(lanelet.existence_probability)},
          {"lane", lanelet.lane == kNoElement ? json() : json(lanelet.lane)},
          {"left", id_of("way", lanelet.left.way)},
          {"right", id_of("way", lanelet.right.way)},
          {"centreline", id_of("centreline", index)},
          {"successors", successions.successors(lanelet)}};
}

}  // namespace

void write_geojson(const std::filesystem::path& path, const RoadNetwork& network, const Origin& origin) {
  const Geometry geometry(network, origin);
  json features = json::array();
  for (std::size_t i = 0; i < network.ways.size(); ++i) {
    const Way& way = network.ways[i];
    features.push_back(feature(id_of("way", i), geometry.line(way),
                               {{"kind", kind_of(way)},
                                {"style", style_of(way)},
                                {"existence", or_null(way.existence_probability)},
                                {"stddev_m", or_null(way.lateral_stddev_m)}}));
  }
  const Successions successions(network);
  for (std::size_t i = 0; i < network.lanelets.size(); ++i) {
    const RoadNetwork::Lanelet& lanelet = network.lanelets[i];
    features.push_back(
        feature(id_of("lanelet", i), geometry.area(lanelet), properties_of(lanelet, i, successions)));
    features.push_back(feature(id_of("centreline", i), geometry.centreline(lanelet),
                               {{"kind", "centreline"}, {"lanelet", id_of("lanelet", i)}}));
  }
  io::write_text(path, json{{"type", "FeatureCollection"}, {"features", features}}.dump() + "\n");
}

}  // namespace laneloom::exports
