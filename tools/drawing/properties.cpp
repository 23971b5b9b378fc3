#include "drawing/properties.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/seconds.hpp"
#include "io/json_fields.hpp"
#include "laneloom/element_names.hpp"
#include "laneloom/polyline.hpp"

namespace laneloom::drawing {
namespace {

using nlohmann::json;

json to_json(const Stretch& range) { return {rounded(range.from_m), rounded(range.to_m)}; }

json to_json(const std::vector<Stretch>& ranges) {
  json list = json::array();
  for (const Stretch& range : ranges) list.push_back(to_json(range));
  return list;
}

void put_lateral_stddev(const std::vector<double>& stddev_m, json& out) {
  if (stddev_m.empty()) return;
  const double sum_m = std::accumulate(stddev_m.begin(), stddev_m.end(), 0.0);
  out["lateral_stddev_mean_m"] = rounded(sum_m / static_cast<double>(stddev_m.size()));
  out["lateral_stddev_max_m"] = rounded(*std::max_element(stddev_m.begin(), stddev_m.end()));
}

void put_existence(double probability, json& out) {
  if (probability >= 0.0) out["existence_probability"] = rounded(probability);
}

void put_lineage(ElementId id, const LocalMap& map, json& out) {
  for (const LineageEvent& event : map.lineage)
    if (event.id == id || event.other == id) out["lineage"].push_back(properties_of(event));
}

/// Puts the ids of the lanes for which `is_beside` holds.
template <typename IsBeside>
void put_lanes(const char* key, const LocalMap& map, json& out, IsBeside is_beside) {
  for (const Lane& lane : map.lanes)
    if (is_beside(lane)) out[key].push_back(lane.id);
}

json to_json(const std::vector<Neighbour>& neighbours) {
  json list = json::array();
  for (const Neighbour& beside : neighbours)
    list.push_back({{"lane", beside.lane},
                    {"range_m", to_json(beside.range)},
                    {"crossable_m", to_json(beside.crossable)}});
  return list;
}

json to_json(const std::vector<Border>& borders) {
  json list = json::array();
  for (const Border& border : borders) {
    json& one = list.emplace_back(json{{"boundary", border.boundary}, {"range_m", to_json(border.range)}});
    if (border.boundary != kNoElement) one["on_boundary_m"] = to_json(border.on_boundary);
  }
  return list;
}

}  // namespace

double rounded(double value) { return std::round(value * 1e3) / 1e3; }

json properties_of(const LineageEvent& event) {
  json out{{"kind", name(event.kind)}, {"element", name(event.element)}, {"id", event.id}};
  if (event.other != kNoElement) out["other"] = event.other;
  return out;
}

json properties_of(const Marking& marking, const LocalMap& map) {
  json out{{"length_m", rounded(length(marking.points))}, {"observations", marking.observations}};
  for (const StyleRange& style : marking.styles)
    out["styles"].push_back({rounded(style.range.from_m), rounded(style.range.to_m), name(style.style)});
  put_existence(marking.existence_probability, out);
  put_lateral_stddev(marking.lateral_stddev_m, out);
  if (marking.first_seen_ns > 0) out["age_s"] = rounded(seconds(map.stamp_ns - marking.first_seen_ns));
  if (marking.last_seen_ns > 0) out["unseen_s"] = rounded(seconds(map.stamp_ns - marking.last_seen_ns));
  const auto is_in = [&](const std::vector<Border>& borders) {
    return std::ranges::find(borders, marking.id, &Border::boundary) != borders.end();
  };
  put_lanes("left_border_of", map, out, [&](const Lane& lane) { return is_in(lane.left_borders); });
  put_lanes("right_border_of", map, out, [&](const Lane& lane) { return is_in(lane.right_borders); });
  put_lineage(marking.id, map, out);
  return out;
}

json properties_of(const Stopline& stopline, const LocalMap& map) {
  json out = properties_of(stopline.marking, map);
  out["lanes"] = stopline.lanes;
  if (!stopline.heading.isZero())
    out["heading"] = {rounded(stopline.heading.x()), rounded(stopline.heading.y())};
  return out;
}

json properties_of(const Lane& lane, const LocalMap& map) {
  json out{{"left_borders", to_json(lane.left_borders)},
           {"right_borders", to_json(lane.right_borders)},
           {"use", name(lane.use)},
           {"evidence", names(lane.evidence)},
           {"width_m", rounded(lane.width_m)},
           {"length_m", rounded(length(lane.centerline))},
           {"direction", name(lane.direction)},
           {"section", lane.section},
           {"left_neighbours", to_json(lane.left_neighbours)},
           {"right_neighbours", to_json(lane.right_neighbours)}};
  put_existence(lane.existence_probability, out);
  if (lane.direction != Lane::Direction::unknown) {
    out["direction_probability"] = rounded(lane.direction_probability);
    out["direction_evidence"] = names(lane.direction_evidence);
  }
  if (!lane.inferred_ranges.empty()) out["inferred_m"] = to_json(lane.inferred_ranges);
  for (const Linkage& linkage : map.linkages) {
    if (linkage.from == lane.id) out["successors"].push_back(linkage.to);
    if (linkage.to == lane.id) out["predecessors"].push_back(linkage.from);
  }
  for (const Stopline& stopline : map.stoplines)
    if (std::find(stopline.lanes.begin(), stopline.lanes.end(), lane.id) != stopline.lanes.end())
      out["stoplines"].push_back(stopline.marking.id);
  put_lineage(lane.id, map, out);
  return out;
}

json properties_of(const Linkage& linkage) {
  return {{"from", linkage.from},
          {"to", linkage.to},
          {"kind", name(linkage.kind)},
          {"turn", name(linkage.turn)},
          {"probability", rounded(linkage.probability)},
          {"evidence", names(linkage.evidence)}};
}

json properties_of(const Way& way) {
  const WayStation& here = way.stations.front();
  json lanes = json::array();
  for (const WayLane& lane : way.lanes) lanes.push_back(lane.id);
  return {{"length_m", rounded(way.known_m)},
          {"confirmed_m", rounded(way.confirmed_m)},
          {"width_m", rounded(here.width_m)},
          {"lanes", lanes}};
}

}  // namespace laneloom::drawing
