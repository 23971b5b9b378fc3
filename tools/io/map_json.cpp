#include <algorithm>
#include <array>
#include <map>

#include "io/element_names.hpp"
#include "io/json_fields.hpp"
#include "io/json_lines.hpp"
#include "io/stamp_and_pose.hpp"

namespace laneloom {
namespace {

using nlohmann::json;

// Reads one of the names.
template <typename Enum, std::size_t N>
auto one_of(const std::array<const char*, N>& names) {
  return [&names](const json& value) {
    const auto found = std::find(names.begin(), names.end(), text(value));
    if (found == names.end()) throw JsonError("'" + text(value) + "' is not known");
    return static_cast<Enum>(found - names.begin());
  };
}

json to_json(const Stretch& range) { return {range.from_m, range.to_m}; }

json to_json(const std::vector<Stretch>& ranges) {
  json list = json::array();
  for (const Stretch& range : ranges) list.push_back(to_json(range));
  return list;
}

json to_json(const std::vector<Neighbour>& neighbours) {
  json list = json::array();
  for (const Neighbour& beside : neighbours)
    list.push_back(
        {{"lane", beside.lane}, {"range", to_json(beside.range)}, {"crossable", to_json(beside.crossable)}});
  return list;
}

json to_json(const Marking& marking) {
  json styles = json::array();
  for (const StyleRange& style : marking.styles)
    styles.push_back({style.range.from_m, style.range.to_m, name(style.style)});
  return {{"id", marking.id},
          {"type", name(marking.type)},
          {"points", polyline_json(marking.points)},
          {"styles", std::move(styles)},
          {"status", name(marking.status)},
          {"existence", marking.existence_probability},
          {"observations", marking.observations},
          {"first_seen_ns", marking.first_seen_ns},
          {"last_seen_ns", marking.last_seen_ns},
          {"lateral_stddev", marking.lateral_stddev_m}};
}

json to_json(const Lane& lane, const LocalMap& map) {
  json successors = json::array();
  for (const Linkage& linkage : map.linkages) {
    if (linkage.from == lane.id) successors.push_back(linkage.to);
  }
  return {{"id", lane.id},
          {"left", polyline_json(lane.left)},
          {"right", polyline_json(lane.right)},
          {"centerline", polyline_json(lane.centerline)},
          {"successors", std::move(successors)},
          {"left_boundary", lane.left_boundary},
          {"right_boundary", lane.right_boundary},
          {"left_range", to_json(lane.left_range)},
          {"right_range", to_json(lane.right_range)},
          {"left_neighbours", to_json(lane.left_neighbours)},
          {"right_neighbours", to_json(lane.right_neighbours)},
          {"width", lane.width_m},
          {"section", lane.section},
          {"direction", name(lane.direction)},
          {"status", name(lane.status)},
          {"existence", lane.existence_probability},
          {"inferred_ranges", to_json(lane.inferred_ranges)}};
}

json to_json(const Linkage& linkage) {
  return {{"from", linkage.from},
          {"to", linkage.to},
          {"kind", name(linkage.kind)},
          {"turn", name(linkage.turn)},
          {"confidence", linkage.confidence},
          {"path", polyline_json(linkage.path)}};
}

/// -1 where it is not given.
double existence(const json& value) {
  const double probability = number(value);
  if (probability != -1.0 && (probability < 0.0 || probability > 1.0))
    throw JsonError("must be from 0 to 1, or -1");
  return probability;
}

Stretch range(const json& value) {
  if (!value.is_array() || value.size() != 2) throw JsonError("must be [from, to]");
  return {number(value[0]), number(value[1])};
}

StyleRange style_range(const json& value) {
  if (!value.is_array() || value.size() != 3) throw JsonError("must be [from, to, style]");
  return {{number(value[0]), number(value[1])}, marking_style(value[2])};
}

std::vector<ElementId> ids(const json& value) { return list(value, count); }

Marking marking(const json& value) {
  Marking out;
  out.id = required(value, "id", count);
  out.type = required(value, "type", marking_type);
  out.points = required(value, "points", polyline);
  const auto styles = [](const json& items) { return list(items, style_range); };
  out.styles = optional(value, "styles", styles).value_or(out.styles);
  out.status = optional(value, "status", one_of<ElementStatus>(kStatusNames)).value_or(out.status);
  out.existence_probability = optional(value, "existence", existence).value_or(out.existence_probability);
  out.observations = optional(value, "observations", count).value_or(out.observations);
  out.first_seen_ns = optional(value, "first_seen_ns", integer).value_or(out.first_seen_ns);
  out.last_seen_ns = optional(value, "last_seen_ns", integer).value_or(out.last_seen_ns);
  out.lateral_stddev_m = optional(value, "lateral_stddev", numbers).value_or(out.lateral_stddev_m);
  return out;
}

std::uint32_t section(const json& value) {
  const std::uint64_t number = count(value);
  if (number > UINT32_MAX) throw JsonError("is too large");
  return static_cast<std::uint32_t>(number);
}

Neighbour neighbour(const json& value) {
  const auto ranges = [](const json& items) { return list(items, range); };
  return {required(value, "lane", count), required(value, "range", range),
          required(value, "crossable", ranges)};
}

Lane lane(const json& value) {
  Lane out;
  out.id = required(value, "id", count);
  out.left = required(value, "left", polyline);
  out.right = required(value, "right", polyline);
  out.centerline = required(value, "centerline", polyline);
  const auto ranges = [](const json& items) { return list(items, range); };
  out.left_boundary = optional(value, "left_boundary", count).value_or(kNoElement);
  out.right_boundary = optional(value, "right_boundary", count).value_or(kNoElement);
  out.left_range = optional(value, "left_range", range).value_or(Stretch{});
  out.right_range = optional(value, "right_range", range).value_or(Stretch{});
  const auto neighbours = [](const json& items) { return list(items, neighbour); };
  out.left_neighbours = optional(value, "left_neighbours", neighbours).value_or(out.left_neighbours);
  out.right_neighbours = optional(value, "right_neighbours", neighbours).value_or(out.right_neighbours);
  out.width_m = optional(value, "width", number).value_or(0.0);
  out.section = optional(value, "section", section).value_or(0);
  out.direction =
      optional(value, "direction", one_of<Lane::Direction>(kDirectionNames)).value_or(out.direction);
  out.status = optional(value, "status", one_of<ElementStatus>(kStatusNames)).value_or(out.status);
  out.existence_probability = optional(value, "existence", existence).value_or(out.existence_probability);
  out.inferred_ranges = optional(value, "inferred_ranges", ranges).value_or(out.inferred_ranges);
  return out;
}

Linkage linkage(const json& value) {
  Linkage out;
  out.from = required(value, "from", count);
  out.to = required(value, "to", count);
  out.kind = optional(value, "kind", one_of<Linkage::Kind>(kLinkageNames)).value_or(out.kind);
  out.turn = optional(value, "turn", one_of<Linkage::Turn>(kTurnNames)).value_or(out.turn);
  out.confidence = optional(value, "confidence", share).value_or(out.confidence);
  out.path = optional(value, "path", polyline).value_or(out.path);
  return out;
}

std::vector<Linkage> linkages(const json& object) {
  const auto all = [](const json& items) { return list(items, linkage); };
  if (auto given = optional(object, "linkages", all)) return *std::move(given);
  std::vector<Linkage> out;
  const auto of_lane = [&](const json& lane) {
    const ElementId from = required(lane, "id", count);
    for (const ElementId to : optional(lane, "successors", ids).value_or(std::vector<ElementId>{})) {
      Linkage& successor = out.emplace_back();
      successor.from = from;
      successor.to = to;
    }
    return true;
  };
  optional(object, "lanes", [&](const json& items) { return list(items, of_lane); });
  return out;
}

// Of its marking, only the id.
Stopline stopline(const json& value) {
  Stopline out;
  out.marking.id = required(value, "id", count);
  out.lanes = optional(value, "lanes", ids).value_or(out.lanes);
  out.heading = optional(value, "heading", point).value_or(out.heading);
  return out;
}

void read_markings(const json& object, LocalMap& map) {
  std::map<ElementId, Stopline> details;
  const auto stoplines = [](const json& items) { return list(items, stopline); };
  for (Stopline& given : optional(object, "stoplines", stoplines).value_or(std::vector<Stopline>{}))
    details[given.marking.id] = std::move(given);
  const auto markings = [](const json& items) { return list(items, marking); };
  for (Marking& read : required(object, "instances", markings)) {
    if (read.type != MarkingType::stopline) {
      map.boundaries.push_back(std::move(read));
      continue;
    }
    Stopline out = details[read.id];
    out.marking = std::move(read);
    map.stoplines.push_back(std::move(out));
  }
}

}  // namespace

std::string to_json_line(const LocalMap& map) {
  json out{{"instances", json::array()},
           {"lanes", json::array()},
           {"linkages", json::array()},
           {"stoplines", json::array()}};
  put_stamp_and_pose(out, map.stamp_ns, map.T_map_body.translation(),
                     Eigen::Quaterniond(map.T_map_body.rotation()));
  for (const Marking& boundary : map.boundaries) out["instances"].push_back(to_json(boundary));
  for (const Stopline& stopline : map.stoplines) {
    const Point& heading = stopline.heading;
    out["instances"].push_back(to_json(stopline.marking));
    out["stoplines"].push_back({{"id", stopline.marking.id},
                                {"lanes", stopline.lanes},
                                {"heading", {heading.x(), heading.y(), heading.z()}}});
  }
  for (const Lane& lane : map.lanes) out["lanes"].push_back(to_json(lane, map));
  for (const Linkage& linkage : map.linkages) out["linkages"].push_back(to_json(linkage));
  return out.dump();
}

LocalMap map_from_json(std::string_view text) {
  const json object = parse_json(text);
  LocalMap map;
  map.stamp_ns = read_stamp_ns(object);
  map.T_map_body = transform(read_pose(object));
  read_markings(object, map);
  const auto lanes = [](const json& items) { return list(items, lane); };
  map.lanes = required(object, "lanes", lanes);
  map.linkages = linkages(object);
  return map;
}

}  // namespace laneloom
