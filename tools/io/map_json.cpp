#include <map>
#include <utility>

#include "base/is_local.hpp"
#include "io/element_json.hpp"
#include "io/json_lines.hpp"
#include "io/stamp_and_pose.hpp"

namespace laneloom::io {
namespace {

using nlohmann::json;

json to_json(const Lane& lane, const LocalMap& map) {
  json successors = json::array();
  for (const Linkage& linkage : map.linkages) {
    if (linkage.from == lane.id) successors.push_back(linkage.to);
  }
  json object = ToJson::of(lane);
  object["successors"] = std::move(successors);
  return object;
}

std::vector<Linkage> linkages(const json& object) {
  if (auto given = optional(object, "linkages", FromJson::element<std::vector<Linkage>>))
    return *std::move(given);
  std::vector<Linkage> out;
  const auto of_lane = [&](const json& lane) {
    const ElementId from = required(lane, "id", count);
    const auto successors = optional(lane, "successors", FromJson::element<std::vector<ElementId>>);
    for (const ElementId to : successors.value_or(std::vector<ElementId>{})) {
      Linkage& successor = out.emplace_back();
      successor.from = from;
      successor.to = to;
    }
    return true;
  };
  optional(object, "lanes", [&](const json& items) { return list(items, of_lane); });
  return out;
}

Way way(const json& value) {
  Way out = FromJson::element<Way>(value);
  if (!out.is_line()) throw JsonError("must have two stations at least, and a step above 0");
  return out;
}

// Reads a stopline. Of its marking, only the id is read.
Stopline stopline(const json& value) {
  Stopline out;
  out.marking.id = required(value, "id", count);
  FromJson::read(value, out);
  return out;
}

void read_markings(const json& object, LocalMap& map) {
  std::map<ElementId, Stopline> details;
  const auto stoplines = [](const json& items) { return list(items, stopline); };
  for (Stopline& given : optional(object, "stoplines", stoplines).value_or(std::vector<Stopline>{}))
    details[given.marking.id] = std::move(given);
  for (Marking& read : required(object, "instances", FromJson::element<std::vector<Marking>>)) {
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
  for (const Marking& boundary : map.boundaries) out["instances"].push_back(ToJson::of(boundary));
  for (const Stopline& stopline : map.stoplines) {
    out["instances"].push_back(ToJson::of(stopline.marking));
    out["stoplines"].push_back(ToJson::of(stopline));
    out["stoplines"].back()["id"] = stopline.marking.id;
  }
  for (const Lane& lane : map.lanes) out["lanes"].push_back(to_json(lane, map));
  for (const Linkage& linkage : map.linkages) out["linkages"].push_back(ToJson::of(linkage));
  if (map.way) out["way"] = ToJson::of(*map.way);
  if (!map.driven_paths.empty()) out["driven_paths"] = ToJson::of(map.driven_paths);
  return out.dump();
}

LocalMap map_from_json(std::string_view text) {
  const json object = parse_json(text);
  LocalMap map;
  map.stamp_ns = read_stamp_ns(object);
  map.T_map_body = transform(read_pose(object));
  read_markings(object, map);
  map.lanes = required(object, "lanes", FromJson::element<std::vector<Lane>>);
  map.linkages = linkages(object);
  map.way = optional(object, "way", way);
  map.driven_paths = optional(object, "driven_paths", FromJson::element<std::vector<DrivenPath>>)
                         .value_or(std::vector<DrivenPath>{});
  if (!is_local(map))
    throw JsonError("a lane has no points, or a line is longer than 100 km or further from the vehicle");
  return map;
}

}  // namespace laneloom::io
