#include "pnc/report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

namespace laneloom::pnc {
namespace {

using nlohmann::json;

std::string id_text(ElementId id) { return id == kNoElement ? "-" : std::to_string(id); }

std::string ids_text(const std::vector<ElementId>& ids) {
  return ids.empty() ? "-" : fmt::format("{}", fmt::join(ids, " "));
}

json id_json(ElementId id) { return id == kNoElement ? json() : json(id); }

std::string age_text(const PublishedMap& map) {
  return map.age_s < 0.0 ? "nothing fused yet" : fmt::format("{:.0f} ms", map.age_s * 1e3);
}

std::string widths_text(const EgoView& ego) {
  std::string text;
  for (std::size_t i = 0; i < kLookahead_m.size(); ++i)
    text += fmt::format("{}{:.0f} m: {}", i == 0 ? "" : "   ", kLookahead_m[i],
                        ego.width_m[i] ? fmt::format("{:.2f} m", *ego.width_m[i]) : "-");
  return text;
}

std::string way_text(const std::optional<Way>& way) {
  if (!way) return "-";
  return fmt::format("{:.0f} m, {:.0f} m of it confirmed, curvature here {:+.4f}/m", way->known_m,
                     way->confirmed_m, way->stations.front().curvature_per_m);
}

json way_json(const std::optional<Way>& way) {
  if (!way) return {};
  const WayStation& here = way->stations.front();
  return {{"known_m", way->known_m},
          {"confirmed_m", way->confirmed_m},
          {"curvature_per_m", here.curvature_per_m},
          {"width_m", here.width_m < 0.0 ? json() : json(here.width_m)}};
}

}  // namespace

PncUpdate judge(PublishedMap map, const PublishedMap* previous) {
  PncUpdate update;
  update.violations = contract::check_contract(map, previous);
  update.missed = contract::missed_maps(map, previous);
  // A planner does not drive on a map that breaks the contract.
  if (update.violations.empty()) update.ego = ego_view(map.map);
  update.map = std::move(map);
  return update;
}

std::string describe(const PncUpdate& update) {
  const LocalMap& map = update.map.map;
  const EgoView& ego = update.ego;
  std::string text = fmt::format(
      "map {:<8} {}   age {}\n"
      "ego lane        {:<8} {}\n"
      "neighbours      left {}   right {}\n"
      "successors      {}\n"
      "width ahead     {}\n"
      "way             {}\n"
      "in the map      {} lanes, {} boundaries, {} stoplines, {} linkages\n",
      update.map.sequence, state_text(update.map.state, update.map.reasons), age_text(update.map),
      id_text(ego.lane), ego.lane == kNoElement ? "" : fmt::format("{:+.2f} m from its middle", ego.offset_m),
      id_text(ego.left_neighbour), id_text(ego.right_neighbour), ids_text(ego.successors), widths_text(ego),
      way_text(map.way), map.lanes.size(), map.boundaries.size(), map.stoplines.size(), map.linkages.size());
  for (const contract::Violation& violation : update.violations)
    text += fmt::format("VIOLATION       {}: {}\n", name(violation.rule), violation.detail);
  return text;
}

std::string summarise(const PncUpdate& update) {
  const LocalMap& map = update.map.map;
  const EgoView& ego = update.ego;
  std::string text = fmt::format(
      "map {} {}, age {}, ego lane {} (left {}, right {}, then {}), width {}, {} lanes, {} linkages",
      update.map.sequence, state_text(update.map.state, update.map.reasons), age_text(update.map),
      id_text(ego.lane), id_text(ego.left_neighbour), id_text(ego.right_neighbour), ids_text(ego.successors),
      widths_text(ego), map.lanes.size(), map.linkages.size());
  for (const contract::Violation& violation : update.violations)
    text += fmt::format("; VIOLATION {}: {}", name(violation.rule), violation.detail);
  return text;
}

json to_json(const PncUpdate& update) {
  const PublishedMap& published = update.map;
  const EgoView& ego = update.ego;
  json reasons = json::array(), violations = json::array(), widths = json::array();
  for (const StateReason reason : published.reasons) reasons.push_back(name(reason));
  for (const contract::Violation& violation : update.violations)
    violations.push_back({{"rule", name(violation.rule)}, {"detail", violation.detail}});
  for (std::size_t i = 0; i < kLookahead_m.size(); ++i)
    widths.push_back(
        {{"ahead_m", kLookahead_m[i]}, {"width_m", ego.width_m[i] ? json(*ego.width_m[i]) : json()}});
  return {{"event", "map"},
          {"sequence", published.sequence},
          {"session_id", published.session_id},
          {"stamp_ns", published.map.stamp_ns},
          {"age_s", published.age_s < 0.0 ? json() : json(published.age_s)},
          {"state", name(published.state)},
          {"reasons", reasons},
          {"ego",
           {{"lane", id_json(ego.lane)},
            {"left_neighbour", id_json(ego.left_neighbour)},
            {"right_neighbour", id_json(ego.right_neighbour)},
            {"successors", ego.successors},
            {"offset_m", ego.lane == kNoElement ? json() : json(ego.offset_m)},
            {"width_ahead", widths}}},
          {"way", way_json(published.map.way)},
          {"lanes", published.map.lanes.size()},
          {"boundaries", published.map.boundaries.size()},
          {"stoplines", published.map.stoplines.size()},
          {"linkages", published.map.linkages.size()},
          {"missed", update.missed},
          {"violations", violations}};
}

}  // namespace laneloom::pnc
