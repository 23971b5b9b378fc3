#include "ros2/diagnostics.hpp"

#include <array>
#include <cstdio>
#include <utility>
#include <vector>

#include "laneloom/state_names.hpp"
#include "ros2/parts.hpp"

namespace laneloom::ros2 {
namespace {

using diagnostic_msgs::msg::dds_::KeyValue_;

/// Levels, as diagnostic_msgs/DiagnosticStatus numbers them.
enum Level : std::uint8_t { kOk = 0, kWarn = 1, kStale = 3 };

Level level_of(MapState state) {
  switch (state) {
    case MapState::ok:
      return kOk;
    case MapState::degraded:
      return kWarn;
    case MapState::stale:
      break;
  }
  return kStale;
}

KeyValue_ entry(const std::string& key, const std::string& value) {
  KeyValue_ to;
  to.key(key);
  to.value(value);
  return to;
}

KeyValue_ entry(const std::string& key, double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3f", value);
  return entry(key, std::string(text.data()));
}

std::vector<KeyValue_> values_of(const ServiceStatus& status) {
  std::vector<KeyValue_> values{entry("uptime_s", status.uptime_s),
                                entry("detections_age_s", status.detections_age_s),
                                entry("poses_age_s", status.poses_age_s),
                                entry("tick_p50_ms", status.tick.p50_ms),
                                entry("tick_p99_ms", status.tick.p99_ms),
                                entry("pending_frames", std::to_string(status.pending_frames)),
                                entry("version", status.version),
                                entry("config_hash", status.config_hash)};
  for (const auto& [name, count] : status.counters) values.push_back(entry(name, std::to_string(count)));
  for (const auto& source : status.sources) {
    values.push_back(entry("source " + source.source + " frames", std::to_string(source.frames)));
    values.push_back(entry("source " + source.source + " fused", std::to_string(source.fused)));
  }
  return values;
}

}  // namespace

diagnostic_msgs::msg::dds_::DiagnosticArray_ to_diagnostics(const ServiceStatus& status,
                                                            const std::string& node,
                                                            const std::string& vehicle_id) {
  diagnostic_msgs::msg::dds_::DiagnosticStatus_ map;
  map.level(level_of(status.state));
  map.name(node + ": lane map");
  map.message(state_text(status.state, status.reasons));
  map.hardware_id(vehicle_id);
  map.values(values_of(status));
  diagnostic_msgs::msg::dds_::DiagnosticArray_ to;
  to.header(to_header(status.published_ns, ""));
  to.status({std::move(map)});
  return to;
}

}  // namespace laneloom::ros2
