#include "status/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/printable.hpp"
#include "laneloom/state_names.hpp"

namespace laneloom::status {
namespace {

using nlohmann::json;

std::string age_text(double age_s) { return age_s < 0.0 ? "never" : fmt::format("{:.2f} s ago", age_s); }
json age_json(double age_s) { return age_s < 0.0 ? json() : json(age_s); }

std::string uptime_text(double uptime_s) {
  const std::int64_t seconds = std::llround(uptime_s);
  return fmt::format("{}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60);
}

std::string time_text(const TimeSummary& time) {
  return fmt::format("mean {:.2f}  p50 {:.2f}  p99 {:.2f}  max {:.2f} ms", time.mean_ms, time.p50_ms,
                     time.p99_ms, time.max_ms);
}

json time_json(const TimeSummary& time) {
  return {{"mean", time.mean_ms}, {"p50", time.p50_ms}, {"p99", time.p99_ms}, {"max", time.max_ms}};
}

/// The counters that are not zero, a line each, with their rise.
std::string counter_lines(const ServiceStatus& status, const std::map<std::string, std::uint64_t>& risen) {
  std::string text;
  for (const auto& [counter, total] : status.counters) {
    if (total == 0) continue;
    const auto rise = risen.find(counter);
    text += fmt::format("  {:<40} {:>10}{}\n", io::printable(counter), total,
                        rise == risen.end() ? "" : fmt::format("  +{}", rise->second));
  }
  return text;
}

/// The values that were learned of a network, a line for each subject. Empty: nothing was learned.
std::string learned_lines(const SourceStatus& source) {
  const std::map<std::string, double> learned(source.learned.begin(), source.learned.end());
  std::string text;
  const auto line = [&](const char* subject, const char* after, const std::vector<std::string>& names) {
    std::string values;
    for (const std::string& name : names)
      if (const auto value = learned.find(name); value != learned.end())
        values += fmt::format(" {:.2f}", value->second);
    if (!values.empty()) text += fmt::format("    {:<22}{}{}\n", subject, values, after);
  };
  line("lateral deviation", " m at 8, 12, 18, 26, 36, 48 m",
       {"stddev_at_8_m", "stddev_at_12_m", "stddev_at_18_m", "stddev_at_26_m", "stddev_at_36_m",
        "stddev_at_48_m"});
  line("believed of pitch", " of what is suspected at once, of what lasts",
       {"pitch_gain", "lasting_pitch_gain"});
  line("believed of pose", " of what is suspected", {"alignment_gain"});
  for (const std::string type : {"laneline", "roadedge"})
    line((type + "s seen").c_str(), " of those there, 0, 10, 20, 30 m ahead",
         {"rate_" + type + "_ahead_0_m", "rate_" + type + "_ahead_10_m", "rate_" + type + "_ahead_20_m",
          "rate_" + type + "_ahead_30_m"});
  line("confidence", " of lines that are there", {"confidence"});
  return text;
}

}  // namespace

std::map<std::string, std::uint64_t> rises(const ServiceStatus& status, const ServiceStatus& previous) {
  const std::map<std::string, std::uint64_t> before(previous.counters.begin(), previous.counters.end());
  std::map<std::string, std::uint64_t> result;
  for (const auto& [counter, total] : status.counters) {
    const auto found = before.find(counter);
    const std::uint64_t old = found == before.end() ? 0 : found->second;
    if (total > old) result.emplace(counter, total - old);
  }
  return result;
}

std::string setting(const ServiceStatus& status, std::string_view key) {
  const auto found =
      std::ranges::find(status.configuration, key, [](const auto& each) { return each.first; });
  return found == status.configuration.end() ? "" : found->second;
}

std::string describe(const ServiceStatus& status, const ServiceStatus* previous) {
  std::string text = fmt::format(
      "{}\n"
      "service         version {}   up {}\n"
      "session         {}   configuration {}\n"
      "detections      {}\n"
      "poses           {}\n"
      "pending frames  {}\n"
      "tick            {}\n"
      "tick's delay    {}\n",
      state_text(status.state, status.reasons), io::printable(status.version), uptime_text(status.uptime_s),
      status.session_id, io::printable(status.config_hash), age_text(status.detections_age_s),
      age_text(status.poses_age_s), status.pending_frames, time_text(status.tick),
      time_text(status.tick_delay));
  for (const SourceStatus& source : status.sources)
    text +=
        fmt::format("source          \"{}\": {} frames, {} to {}, session {}\n", io::printable(source.source),
                    source.frames, source.first_sequence, source.last_sequence, source.session_id) +
        learned_lines(source);
  return text +
         counter_lines(status, previous ? rises(status, *previous) : std::map<std::string, std::uint64_t>{});
}

json to_json(const ServiceStatus& status, const ServiceStatus* previous) {
  json reasons = json::array(), sources = json::array(), counters = json::object();
  for (const StateReason reason : status.reasons) reasons.push_back(name(reason));
  for (const SourceStatus& source : status.sources)
    sources.push_back(
        {{"source", source.source},
         {"session_id", source.session_id},
         {"first_sequence", source.first_sequence},
         {"last_sequence", source.last_sequence},
         {"frames", source.frames},
         {"fused", source.fused},
         {"lag_s", source.lag_s},
         {"learned", std::map<std::string, double>(source.learned.begin(), source.learned.end())}});
  for (const auto& [counter, total] : status.counters) counters[counter] = total;
  return {{"event", "status"},
          {"sequence", status.sequence},
          {"session_id", status.session_id},
          {"published_ns", status.published_ns},
          {"state", name(status.state)},
          {"reasons", reasons},
          {"uptime_s", status.uptime_s},
          {"version", status.version},
          {"config_hash", status.config_hash},
          {"detections_age_s", age_json(status.detections_age_s)},
          {"poses_age_s", age_json(status.poses_age_s)},
          {"pending_frames", status.pending_frames},
          {"tick_ms", time_json(status.tick)},
          {"tick_delay_ms", time_json(status.tick_delay)},
          {"sources", sources},
          {"counters", counters},
          {"rises", previous ? json(rises(status, *previous)) : json()}};
}

}  // namespace laneloom::status
