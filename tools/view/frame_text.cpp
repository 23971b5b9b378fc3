#include "view/frame_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "drawing/drawing_json.hpp"
#include "drawing/frame_elements.hpp"
#include "drawing/map_elements.hpp"
#include "drawing/properties.hpp"
#include "drawing/traffic_elements.hpp"
#include "io/json_text.hpp"
#include "laneloom/state_names.hpp"
#include "status/report.hpp"

namespace laneloom::view {
namespace {

using nlohmann::json;

double stamp_s(std::int64_t stamp_ns) { return drawing::rounded(static_cast<double>(stamp_ns) * 1e-9); }
json known(double value) { return value < 0.0 ? json() : json(drawing::rounded(value)); }

std::uint64_t refusals(const ServiceStatus& status) {
  std::uint64_t sum = 0;
  for (const auto& [counter, count] : status.counters)
    if (counter.find("_refused_") != std::string::npos) sum += count;
  return sum;
}

void put_status(json& summary, const ServiceStatus& status) {
  summary["tick_ms"] = drawing::rounded(status.tick.mean_ms);
  summary["tick_max_ms"] = drawing::rounded(status.tick.max_ms);
  summary["refused"] = refusals(status);
}

void put(const char* key, const std::optional<double>& value, json& to) {
  if (value) to[key] = drawing::rounded(*value);
}

/// The time of a figure about an earlier frame is that of the frame.
json quality_json(const MapQuality& quality, const ViewMoment& moment) {
  json out{{"own_lane", quality.own_lane}, {"lanes", quality.lanes}};
  put("jump_m", quality.jump_m, out);
  if (quality.unsteady) out["unsteady"] = *quality.unsteady;
  put("error_m", quality.lateral_error_m, out);
  put("recall", quality.recall, out);
  if (const auto& later = quality.later) {
    json& proved =
        out["later"] = {{"time_s", stamp_s(moment.seen_ns - (moment.map.map.stamp_ns - later->stamp_ns))}};
    put("recall", later->recall, proved);
    put("precision", later->precision, proved);
    put("error_m", later->lateral_error_m, proved);
  }
  return out;
}

json summary_json(const ViewMoment& moment, const FramePlace& place) {
  const PublishedMap& map = moment.map;
  json summary{{"number", place.number}, {"time_s", stamp_s(moment.seen_ns)}, {"alive", moment.alive}};
  for (const LineageEvent& event : map.map.lineage)
    summary["lineage"].push_back(drawing::properties_of(event));
  for (const ViewEvent& event : place.events) summary["events"].push_back({event.kind, event.text});
  for (const MapQuality& quality : place.quality) summary["quality"].push_back(quality_json(quality, moment));
  if (moment.repeated) summary["repeated"] = true;
  if (!moment.has_state) return summary;
  summary["state"] = name(map.state);
  for (const StateReason reason : map.reasons) summary["reasons"].push_back(name(reason));
  if (moment.repeated) return summary;  // its times are those of another moment
  summary["age_s"] = known(map.age_s);
  summary["lag_s"] = known(map.lag_s);
  summary["latency_ms"] = static_cast<double>(moment.seen_ns - map.published_ns) * 1e-6;
  if (moment.status) put_status(summary, *moment.status);
  return summary;
}

double setting(const ServiceStatus& status, std::string_view key, double otherwise) {
  for (const auto& [name, value] : status.configuration)
    if (name == key) return std::strtod(value.c_str(), nullptr);
  return otherwise;
}

/// The range of the service, if its status tells it, or else `range`.
RangeConfig range_of(const ViewMoment& moment, RangeConfig range) {
  if (!moment.status) return range;
  range.forward_min_m = setting(*moment.status, "mapper.range.forward_min_m", range.forward_min_m);
  range.forward_max_m = setting(*moment.status, "mapper.range.forward_max_m", range.forward_max_m);
  range.side_max_m = setting(*moment.status, "mapper.range.side_max_m", range.side_max_m);
  return range;
}

drawing::Drawing drawing_of(const LocalMap& map, const ViewMoment& moment, const RangeConfig& range) {
  drawing::Drawing drawing;
  add_map(map, drawing);
  add_markings(map, drawing);
  add_uncertainty(map, drawing);
  add_ids(map, drawing);
  for (const auto& [objects, T_map_body] : moment.traffic.seen) add_objects(objects, T_map_body, drawing);
  add_trails(moment.traffic.trails, map, drawing);
  if (moment.detections) {
    add_detections(*moment.detections, map.T_map_body, drawing);
    add_view(*moment.detections, map.T_map_body, drawing);
  }
  add_range(range_of(moment, range), map.T_map_body, drawing);
  add_vehicle(moment.pose ? transform(*moment.pose) : map.T_map_body, drawing);
  return drawing;
}

}  // namespace

std::string summary_text(const ViewMoment& moment, const FramePlace& place) {
  return io::json_text(summary_json(moment, place));
}

std::string frame_text(const ViewMoment& moment, const FramePlace& place, const RangeConfig& range) {
  json frame = summary_json(moment, place);
  frame.update(to_json(drawing_of(moment.map.map, moment, range)));
  const auto put_beside = [&](const LocalMap& map) {
    frame["others"].push_back({{"elements", std::move(to_json(drawing_of(map, moment, range))["elements"])}});
  };
  std::ranges::for_each(moment.others, put_beside);
  if (moment.truth) put_beside(*moment.truth);
  if (!moment.why.is_null()) frame["why"] = moment.why;
  frame["sequence"] = moment.map.sequence;
  frame["session_id"] = std::to_string(moment.map.session_id);
  frame["map_id"] = std::to_string(moment.map.map_id);
  if (moment.status) frame["status"] = status::to_json(*moment.status, nullptr);
  return io::json_text(frame);
}

}  // namespace laneloom::view
