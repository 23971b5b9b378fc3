#include "simulation/lanelet2.hpp"

#include <GeographicLib/LocalCartesian.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <pugixml.hpp>
#include <set>
#include <stdexcept>
#include <string_view>

#include "laneloom/polyline.hpp"
#include "sd_map/osm_elements.hpp"
#include "simulation/borders.hpp"
#include "simulation/route.hpp"

namespace laneloom::simulation {
namespace {

using sd_map::id_of;
using sd_map::name_of;
using sd_map::OsmId;
using sd_map::tag;

constexpr double kJoin_m = 0.01;
constexpr double kMaxCoordinate_m = 1e7;
constexpr std::array kEdgeTypes{"curbstone", "road_border", "wall", "fence", "guard_rail"};
constexpr std::array kLaneSubtypes{"road", "highway", "bus_lane", "play_street", "emergency_lane"};

[[noreturn]] void refuse(const pugi::xml_node& element, const std::string& complaint) {
  throw std::runtime_error(name_of(element) + ": " + complaint);
}

double coordinate(const pugi::xml_node& node, std::string_view text, const char* key) {
  std::size_t used = 0;
  double value = 0.0;
  try {
    value = std::stod(std::string(text), &used);
  } catch (const std::logic_error&) {
    used = 0;
  }
  if (used == 0 || used != text.size() || !(std::abs(value) < kMaxCoordinate_m))
    refuse(node, std::string(key) + " must be a number");
  return value;
}

std::map<OsmId, Point> read_nodes(const pugi::xml_node& osm) {
  const auto nodes = osm.children("node");
  const bool local = std::all_of(nodes.begin(), nodes.end(), [](const pugi::xml_node& node) {
    return !tag(node, "local_x").empty() && !tag(node, "local_y").empty();
  });
  std::optional<GeographicLib::LocalCartesian> projection;
  std::map<OsmId, Point> points;
  for (const pugi::xml_node& node : nodes) {
    const std::string_view ele = tag(node, "ele");
    const double height_m = ele.empty() ? 0.0 : coordinate(node, ele, "ele");
    Point& point = points[id_of(node)];
    if (local) {
      point = {coordinate(node, tag(node, "local_x"), "local_x"),
               coordinate(node, tag(node, "local_y"), "local_y"), height_m};
      continue;
    }
    const double lat_deg = coordinate(node, node.attribute("lat").as_string(), "lat");
    const double lon_deg = coordinate(node, node.attribute("lon").as_string(), "lon");
    if (std::abs(lat_deg) > 90.0 || std::abs(lon_deg) > 360.0) refuse(node, "lat and lon must be degrees");
    if (!projection) projection.emplace(lat_deg, lon_deg, 0.0);
    projection->Forward(lat_deg, lon_deg, height_m, point.x(), point.y(), point.z());
    point.z() = height_m;  // not above the tangent plane: level roads stay level
  }
  return points;
}

struct Way {
  std::vector<sd_map::OsmId> nodes{};
  Polyline points{};
  ElementId marking = kNoElement;
  bool is_virtual = false;
};

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

// Reads the ways, and emits their markings.
std::map<OsmId, Way> read_ways(const pugi::xml_node& osm, const std::map<OsmId, Point>& nodes, Road& road) {
  std::map<OsmId, Way> ways;
  for (const pugi::xml_node& element : osm.children("way")) {
    Way& way = ways[id_of(element)];
    for (const pugi::xml_node& nd : element.children("nd")) {
      const auto node = nodes.find(id_of(nd, "ref"));
      if (node == nodes.end()) refuse(element, std::string("has no node ") + nd.attribute("ref").as_string());
      way.nodes.push_back(node->first);
      way.points.push_back(node->second);
    }
    way.is_virtual = tag(element, "type") == "virtual";
    const std::optional<MarkingType> type = marking_type(element);
    if (!type || way.points.size() < 2 || !(length(way.points) > 0.0)) continue;
    way.marking = road.markings.size() + 1;
    road.markings.push_back({way.marking, *type, marking_style(element, *type), way.points});
  }
  return ways;
}

Way reversed(Way way) {
  std::reverse(way.nodes.begin(), way.nodes.end());
  std::reverse(way.points.begin(), way.points.end());
  return way;
}

// Turns each border so that the middle of the other is on its proper side, as Lanelet2's geometry::align()
// does.
void align(Way& left, Way& right) {
  const auto middle = [](const Polyline& points) -> Point {
    return points.size() > 2 ? points[points.size() / 2] : Point(0.5 * (points.front() + points.back()));
  };
  const Point middle_left = middle(left.points), middle_right = middle(right.points);
  const bool turn_left = MeasuredPolyline(left.points).project(middle_right).lateral_m > 0.0;
  const bool turn_right = MeasuredPolyline(right.points).project(middle_left).lateral_m < 0.0;
  if (turn_left) left = reversed(std::move(left));
  if (turn_right) right = reversed(std::move(right));
}

struct Lanelet {
  Way left, right;
};

const Way& border(const pugi::xml_node& relation, const char* role, const std::map<OsmId, Way>& ways) {
  const Way* found = nullptr;
  for (const pugi::xml_node& member : relation.children("member")) {
    if (std::string_view(member.attribute("role").as_string()) != role) continue;
    const auto way = ways.find(id_of(member, "ref"));
    if (way == ways.end()) refuse(relation, std::string("has no way ") + member.attribute("ref").as_string());
    if (found != nullptr) refuse(relation, std::string("has more than one ") + role + " border");
    found = &way->second;
  }
  if (found == nullptr) refuse(relation, std::string("has no ") + role + " border");
  if (!(length(found->points) > 0.0))
    refuse(relation, std::string("has a ") + role + " border without length");
  return *found;
}

bool is_vehicle_lane(const pugi::xml_node& relation) {
  const std::string_view subtype = tag(relation, "subtype");
  return tag(relation, "type") == "lanelet" &&
         std::find(kLaneSubtypes.begin(), kLaneSubtypes.end(), subtype) != kLaneSubtypes.end();
}

std::vector<Lanelet> read_lanes(const pugi::xml_node& osm, const std::map<OsmId, Way>& ways, Road& road) {
  std::vector<Lanelet> lanelets;
  LengthLimit limit;
  for (const pugi::xml_node& relation : osm.children("relation")) {
    if (!is_vehicle_lane(relation)) continue;
    Lanelet lanelet{border(relation, "left", ways), border(relation, "right", ways)};
    if (!limit.add(lanelet.left.points) || !limit.add(lanelet.right.points))
      refuse(relation, LengthLimit::kComplaint);
    align(lanelet.left, lanelet.right);
    const auto [left, right] = std::pair(lanelet.left.marking, lanelet.right.marking);
    road.lanes.push_back({.id = road.lanes.size() + 1,
                          .left = lanelet.left.points,
                          .right = lanelet.right.points,
                          .centerline = midway(lanelet.left.points, lanelet.right.points),
                          .left_marking = left,
                          .right_marking = right,
                          .in_intersection = !tag(relation, "turn_direction").empty() ||
                                             (lanelet.left.is_virtual && lanelet.right.is_virtual),
                          .successors = {}});
    lanelets.push_back(std::move(lanelet));
  }
  return lanelets;
}

void add_successors(const std::vector<Lanelet>& lanelets, Road& road) {
  std::map<std::pair<OsmId, sd_map::OsmId>, std::vector<ElementId>>
      starting;  // by the first nodes of left and right
  for (std::size_t i = 0; i < lanelets.size(); ++i)
    starting[{lanelets[i].left.nodes.front(), lanelets[i].right.nodes.front()}].push_back(road.lanes[i].id);
  for (std::size_t i = 0; i < lanelets.size(); ++i) {
    const auto next = starting.find({lanelets[i].left.nodes.back(), lanelets[i].right.nodes.back()});
    if (next != starting.end()) road.lanes[i].successors = next->second;
  }
}

// In right-hand traffic, lanes of opposite directions share their left borders; in left-hand traffic, their
// right ones.
bool is_right_hand(const std::vector<Lanelet>& lanelets) {
  const auto shared_with_opposite = [&](Way Lanelet::*side) {
    std::set<std::vector<sd_map::OsmId>> borders;
    std::size_t shared = 0;
    for (const Lanelet& lanelet : lanelets) {
      if (borders.contains(reversed(lanelet.*side).nodes)) ++shared;
      borders.insert((lanelet.*side).nodes);
    }
    return shared;
  };
  const std::size_t rights = shared_with_opposite(&Lanelet::right);
  return rights <= shared_with_opposite(&Lanelet::left) || 10 * rights < lanelets.size();
}

}  // namespace

Road load_lanelet2(const std::filesystem::path& osm_file, double speed_mps) {
  try {
    pugi::xml_document document;
    if (const auto result = document.load_file(osm_file.c_str()); !result)
      throw std::runtime_error(std::string(result.description()) + " at byte " +
                               std::to_string(result.offset));
    const pugi::xml_node osm = document.child("osm");
    if (!osm) throw std::runtime_error("has no element osm");
    Road road;
    road.name = osm_file.stem().string();
    const std::map<OsmId, Way> ways = read_ways(osm, read_nodes(osm), road);
    const std::vector<Lanelet> lanelets = read_lanes(osm, ways, road);
    if (lanelets.empty()) throw std::runtime_error("has no lanes");
    add_successors(lanelets, road);
    road.right_hand_traffic = is_right_hand(lanelets);
    join_markings(road, kJoin_m);
    road.drive = Drive::along(joined_centerlines(road, long_way(road)), speed_mps);
    return road;
  } catch (const std::exception& error) {
    throw std::runtime_error(osm_file.string() + ": " + error.what());
  }
}

}  // namespace laneloom::simulation
