#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <type_traits>
#include <utility>

#include "base/fields.hpp"
#include "io/json_fields.hpp"
#include "io/json_lines.hpp"
#include "io/stamp_and_pose.hpp"
#include "laneloom/element_names.hpp"

namespace laneloom::io {
namespace {

using nlohmann::json;

// A reader of one of the names.
template <typename Enum, std::size_t N>
auto one_of(const std::array<const char*, N>& names) {
  return [&names](const json& value) {
    const auto found = std::find(names.begin(), names.end(), text(value));
    if (found == names.end()) throw JsonError("'" + text(value) + "' is not known");
    return static_cast<Enum>(found - names.begin());
  };
}

/// The value of a field as JSON.
struct ToJson {
  template <class Number>
  requires std::is_arithmetic_v<Number>
  static json of(Number value) { return value; }
  template <class Enum>
  requires std::is_enum_v<Enum>
  static json of(Enum value) { return name(value); }
  static json of(const Stretch& range) { return {range.from_m, range.to_m}; }
  static json of(const Polyline& line) { return polyline_json(line); }
  template <class Value>
  static json of(const std::vector<Value>& values) {
    json list = json::array();
    for (const Value& value : values) list.push_back(of(value));
    return list;
  }
  template <HasFields Struct>
  static json of(const Struct& element) {
    json object;
    for_each_field<Struct>([&](const auto& field) { object[field.key] = of(element.*field.member); });
    return object;
  }
};

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
  json object = ToJson::of(lane);
  object["successors"] = std::move(successors);
  return object;
}

/// An existence probability; -1: not estimated.
double existence(const json& value) {
  const double probability = number(value);
  if (probability != -1.0 && (probability < 0.0 || probability > 1.0))
    throw JsonError("must be from 0 to 1, or -1");
  return probability;
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

/// Reads the value of a field.
struct FromJson {
  static void read(const json& value, double& to) { to = number(value); }
  static void read(const json& value, ElementId& to) { to = count(value); }
  static void read(const json& value, std::uint32_t& to) {
    const std::uint64_t whole = count(value);
    if (whole > UINT32_MAX) throw JsonError("is too large");
    to = static_cast<std::uint32_t>(whole);
  }
  static void read(const json& value, ElementStatus& to) { to = one_of<ElementStatus>(kStatusNames)(value); }
  static void read(const json& value, Lane::Direction& to) {
    to = one_of<Lane::Direction>(kDirectionNames)(value);
  }
  static void read(const json& value, Linkage::Kind& to) { to = one_of<Linkage::Kind>(kLinkageNames)(value); }
  static void read(const json& value, Linkage::Turn& to) { to = one_of<Linkage::Turn>(kTurnNames)(value); }
  static void read(const json& value, Stretch& to) {
    if (!value.is_array() || value.size() != 2) throw JsonError("must be [from, to]");
    to = {number(value[0]), number(value[1])};
  }
  static void read(const json& value, Polyline& to) { to = polyline(value); }
  template <class Value>
  static void read(const json& value, std::vector<Value>& to) {
    to = list(value, element<Value>);
  }
  template <HasFields Struct>
  static void read(const json& object, Struct& to) {
    for_each_field<Struct>([&]<class Value, class Of>(const Field<Struct, Value, Of>& field) {
      auto value = optional(object, field.key, element<Value>);
      if (!value && field.is_needed) throw JsonError(field.key, "is missing");
      if (value) to.*field.member = *std::move(value);
    });
  }
  template <class Value>
  static Value element(const json& value) {
    Value to{};
    read(value, to);
    return to;
  }
};

Lane lane(const json& value) {
  optional(value, "existence", existence);
  return FromJson::element<Lane>(value);
}

Linkage linkage(const json& value) {
  optional(value, "confidence", share);
  return FromJson::element<Linkage>(value);
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

// Reads a stopline. Of its marking, only the id is read.
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
  for (const Linkage& linkage : map.linkages) out["linkages"].push_back(ToJson::of(linkage));
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

}  // namespace laneloom::io
