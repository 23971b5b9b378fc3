#include "simulation/lanelet2_ways.hpp"

#include <GeographicLib/LocalCartesian.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <string_view>

#include "laneloom/polyline.hpp"

namespace laneloom::simulation {
namespace {

using sd_map::id_of;
using sd_map::OsmId;
using sd_map::tag;

constexpr double kMaxCoordinate_m = 1e7;
constexpr std::array kEdgeTypes{"curbstone", "road_border", "wall", "fence", "guard_rail"};

double coordinate(const pugi::xml_node& node, std::string_view text, const char* key) {
  std::size_t used = 0;
  double value = 0.0;
  try {
    value = std::stod(std::string(text), &used);
  } catch (const std::logic_error&) {
    used = 0;
  }
  if (used == 0 || used != text.size() || !(std::abs(value) < kMaxCoordinate_m))
    refuse(node, std::string("has no number within reach as ") + key);
  return value;
}

bool has_local(const pugi::xml_node& node) {
  return !tag(node, "local_x").empty() && !tag(node, "local_y").empty();
}

/// Takes degrees to metres about the first node that has a place.
class Projection {
 public:
  Point operator()(const pugi::xml_node& node) {
    const double lat_deg = coordinate(node, node.attribute("lat").as_string(), "lat");
    const double lon_deg = coordinate(node, node.attribute("lon").as_string(), "lon");
    if (std::abs(lat_deg) > 90.0 || std::abs(lon_deg) > 360.0) refuse(node, "has no degrees as lat and lon");
    if (!projection_) projection_.emplace(lat_deg, lon_deg, 0.0);
    Point point;
    projection_->Forward(lat_deg, lon_deg, 0.0, point.x(), point.y(), point.z());
    return point;
  }

 private:
  std::optional<GeographicLib::LocalCartesian> projection_;
};

/// A height that is no number counts as one that is absent.
double height_of(const pugi::xml_node& node, LeftOut& left_out) {
  const std::string_view ele = tag(node, "ele");
  if (ele.empty()) return 0.0;
  try {
    return coordinate(node, ele, "ele");
  } catch (const BadElement& error) {
    if (left_out.strict()) throw;
    left_out.add("the height of a node, whose ele is no number", error.place());
    return 0.0;
  }
}

std::optional<MarkingType> marking_type(const pugi::xml_node& way) {
  const std::string_view type = tag(way, "type");
  if (type == "line_thin" || type == "line_thick") return MarkingType::laneline;
  if (type == "stop_line") return MarkingType::stopline;
  if (std::find(kEdgeTypes.begin(), kEdgeTypes.end(), type) != kEdgeTypes.end()) return MarkingType::roadedge;
  return std::nullopt;
}

MarkingStyle marking_style(const pugi::xml_node& way, MarkingType type) {
  if (type != MarkingType::laneline) return MarkingStyle::solid;
  const std::string_view subtype = tag(way, "subtype");
  if (subtype == "solid" || subtype == "solid_solid") return MarkingStyle::solid;
  if (subtype == "dashed") return MarkingStyle::dashed;
  return MarkingStyle::unknown;
}

Way read_way(const pugi::xml_node& element, const std::map<OsmId, Point>& nodes) {
  Way way;
  for (const pugi::xml_node& nd : element.children("nd")) {
    const auto node = nodes.find(id_of(nd, "ref"));
    if (node == nodes.end())
      refuse(element, "has no node", std::string(" ") + nd.attribute("ref").as_string());
    way.nodes.push_back(node->first);
    way.points.push_back(node->second);
  }
  way.is_virtual = tag(element, "type") == "virtual";
  return way;
}

}  // namespace

std::map<OsmId, Point> read_nodes(const pugi::xml_node& osm, LeftOut& left_out) {
  const auto nodes = osm.children("node");
  // One node that lacks them must not move the whole map to another frame.
  const bool local =
      2 * std::count_if(nodes.begin(), nodes.end(), has_local) > std::distance(nodes.begin(), nodes.end());
  Projection projected;
  std::map<OsmId, Point> points;
  for_each_element(osm, "node", left_out, [&](const pugi::xml_node& node) {
    if (local && !has_local(node)) refuse(node, "has no local_x and local_y, as most nodes have");
    Point point = local ? Point(coordinate(node, tag(node, "local_x"), "local_x"),
                                coordinate(node, tag(node, "local_y"), "local_y"), 0.0)
                        : projected(node);
    // Not above the tangent plane: level roads stay level.
    point.z() = height_of(node, left_out);
    if (!points.emplace(id_of(node), point).second) refuse(node, "is given twice");
  });
  return points;
}

std::map<OsmId, Way> read_ways(const pugi::xml_node& osm, const std::map<OsmId, Point>& nodes, Road& road,
                               LeftOut& left_out) {
  std::map<OsmId, Way> ways;
  for_each_element(osm, "way", left_out, [&](const pugi::xml_node& element) {
    const auto [found, is_new] = ways.try_emplace(id_of(element), read_way(element, nodes));
    if (!is_new) refuse(element, "is given twice");
    Way& way = found->second;
    const std::optional<MarkingType> type = marking_type(element);
    if (!type || way.points.size() < 2 || !(length(way.points) > 0.0)) return;
    way.marking = road.markings.size() + 1;
    road.markings.push_back({way.marking, *type, marking_style(element, *type), way.points});
  });
  return ways;
}

}  // namespace laneloom::simulation
