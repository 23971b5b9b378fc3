#include "simulation/lanelet2.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <pugixml.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>

#include "laneloom/polyline.hpp"
#include "simulation/borders.hpp"
#include "simulation/lanelet2_ways.hpp"
#include "simulation/map_file.hpp"
#include "simulation/route.hpp"

namespace laneloom::simulation {
namespace {

using sd_map::id_of;
using sd_map::OsmId;
using sd_map::tag;

constexpr double kJoin_m = 0.01;
constexpr double kPlaceStep_m = 4.0;
constexpr double kOnOneAnother_m = 2.0;  // at most, between the middles of two directions of a single way
constexpr double kNeighbours_m = 6.0;    // between the middles of two lanes that are side by side
constexpr double kOpposite_cos = -0.9;   // between directions that are opposite
constexpr std::array kLaneSubtypes{"road", "highway", "bus_lane", "play_street", "emergency_lane", "exit"};

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
    if (way == ways.end())
      refuse(relation, "has no way", std::string(" ") + member.attribute("ref").as_string());
    if (found != nullptr) refuse(relation, std::string("has more than one ") + role + " border");
    found = &way->second;
  }
  if (found == nullptr) refuse(relation, std::string("has no ") + role + " border");
  if (!(length(found->points) > 0.0))
    refuse(relation, std::string("has a ") + role + " border without length");
  return *found;
}

/// Where a lanelet names participants, its subtype does not count, and no others may use it. A lanelet
/// without either is for vehicles.
bool is_vehicle_lane(const pugi::xml_node& relation) {
  if (tag(relation, "type") != "lanelet") return false;
  bool names_participants = false;
  for (const pugi::xml_node& each : relation.children("tag")) {
    const std::string_view key = each.attribute("k").as_string();
    if (!key.starts_with("participant:")) continue;
    names_participants = true;
    if (key.starts_with("participant:vehicle") && each.attribute("v").as_bool()) return true;
  }
  const std::string_view subtype = tag(relation, "subtype");
  return !names_participants &&
         (subtype.empty() || std::ranges::find(kLaneSubtypes, subtype) != kLaneSubtypes.end());
}

RoadLane lane_of(const Lanelet& lanelet, const pugi::xml_node& relation, ElementId id) {
  return {.id = id,
          .left = lanelet.left.points,
          .right = lanelet.right.points,
          .centerline = midway(lanelet.left.points, lanelet.right.points),
          .left_marking = lanelet.left.marking,
          .right_marking = lanelet.right.marking,
          .in_intersection = !tag(relation, "turn_direction").empty() ||
                             (lanelet.left.is_virtual && lanelet.right.is_virtual),
          .successors = {}};
}

std::vector<Lanelet> read_lanes(const pugi::xml_node& osm, const std::map<OsmId, Way>& ways, Road& road,
                                LeftOut& left_out) {
  std::vector<Lanelet> lanelets;
  std::set<OsmId> ids;
  LengthLimit limit;
  for_each_element(osm, "relation", left_out, [&](const pugi::xml_node& relation) {
    if (!is_vehicle_lane(relation)) return;
    if (!ids.insert(id_of(relation)).second) refuse(relation, "is given twice");
    Lanelet lanelet{border(relation, "left", ways), border(relation, "right", ways)};
    if (!limit.add(lanelet.left.points) || !limit.add(lanelet.right.points))
      refuse(relation, LengthLimit::kComplaint);
    align(lanelet.left, lanelet.right);
    road.lanes.push_back(lane_of(lanelet, relation, road.lanes.size() + 1));
    lanelets.push_back(std::move(lanelet));
  });
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

/// How many borders on a side are also the border on that side of a lane in the opposite direction.
std::size_t shared_with_opposite(const std::vector<Lanelet>& lanelets, Way Lanelet::*side) {
  std::set<std::vector<sd_map::OsmId>> borders;
  std::size_t shared = 0;
  for (const Lanelet& lanelet : lanelets) {
    if (borders.contains(reversed(lanelet.*side).nodes)) ++shared;
    borders.insert((lanelet.*side).nodes);
  }
  return shared;
}

/// At how many places of lanes more the nearest lane in the opposite direction lies to the left than to the
/// right.
int opposite_to_the_left(const Road& road) {
  std::vector<MeasuredPolyline> lines;
  for (const RoadLane& lane : road.lanes) lines.emplace_back(lane.centerline);
  int balance = 0;
  for (const MeasuredPolyline& line : lines) {
    for (double at_m = 0.5 * kPlaceStep_m; at_m < line.length(); at_m += kPlaceStep_m) {
      Projection nearest{.distance_m = kNeighbours_m};
      for (const MeasuredPolyline& other : lines) {
        const Projection foot = other.project(line.at(at_m), nearest.distance_m);
        if (foot.inside && std::abs(foot.lateral_m) > kOnOneAnother_m &&
            line.direction(at_m).dot(other.direction(foot)) < kOpposite_cos)
          nearest = foot;
      }
      // Each of two opposite lanes is on the same side of the other.
      if (nearest.inside) balance += nearest.lateral_m > 0.0 ? 1 : -1;
    }
  }
  return balance;
}

/// In right-hand traffic, lanes of opposite directions share their left borders; in left-hand traffic, their
/// right ones.
bool is_right_hand(const std::vector<Lanelet>& lanelets, const Road& road) {
  const std::size_t lefts = shared_with_opposite(lanelets, &Lanelet::left);
  const std::size_t rights = shared_with_opposite(lanelets, &Lanelet::right);
  return lefts + rights > 0 ? rights <= lefts : opposite_to_the_left(road) >= 0;
}

std::string why_no_lanes(const MapFile& file) {
  std::set<std::string_view> subtypes;
  bool has_lanelets = false, are_for_others = true;
  for (const pugi::xml_node& relation : file.root().children("relation")) {
    if (tag(relation, "type") != "lanelet") continue;
    has_lanelets = true;
    are_for_others = are_for_others && !is_vehicle_lane(relation);
    subtypes.insert(tag(relation, "subtype"));
  }
  if (!file.is_whole()) return "has no lanes for vehicles before the place where it is damaged or cut off";
  if (!has_lanelets)
    return "has no relation of the type lanelet, as an extract of OpenStreetMap has none; a Lanelet2 map is "
           "needed";
  std::string reason = "has no lanes for vehicles";
  if (are_for_others)
    for (const std::string_view subtype : subtypes)
      reason += (subtype == *subtypes.begin() ? "; its lanelets are " : " and ") + std::string(subtype);
  return reason;
}

}  // namespace

Road load_lanelet2(const std::filesystem::path& osm_file, double speed_mps, LeftOut& left_out) {
  try {
    const MapFile file(osm_file, "osm", "a Lanelet2 map (.osm)", left_out);
    const pugi::xml_node& osm = file.root();
    sd_map::remove_deleted(osm);
    Road road;
    road.name = osm_file.stem().string();
    const std::map<OsmId, Way> ways = read_ways(osm, read_nodes(osm, left_out), road, left_out);
    const std::vector<Lanelet> lanelets = read_lanes(osm, ways, road, left_out);
    if (lanelets.empty()) throw std::runtime_error(why_no_lanes(file));
    if (!has_lines(road))
      throw std::runtime_error(
          "has no lines that can be seen: no way has a type of marking, such as line_thin, curbstone or "
          "road_border");
    add_successors(lanelets, road);
    road.right_hand_traffic = is_right_hand(lanelets, road);
    join_markings(road, kJoin_m);
    road.drive = Drive::along(joined_centerlines(road, long_way(road)), speed_mps);
    return road;
  } catch (const std::exception& error) {
    throw std::runtime_error(osm_file.string() + ": " + error.what());
  }
}

}  // namespace laneloom::simulation
