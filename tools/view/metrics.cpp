#include "view/metrics.hpp"

#include <fmt/format.h>
#include <utf8.h>

#include <array>
#include <iterator>
#include <utility>

#include "laneloom/state_names.hpp"

namespace laneloom::view {
namespace {

using Labels = std::vector<std::pair<std::string_view, std::string>>;

/// A name that others gave themselves, as the value of a label: UTF-8, with the escapes of the format.
std::string label_text(const std::string& text) {
  std::string escaped;
  for (const char c : utf8::replace_invalid(text)) {
    if (c == '\\' || c == '"' || c == '\n') escaped += '\\';
    escaped += c == '\n' ? 'n' : c;
  }
  return escaped;
}

class Text {
 public:
  void family(std::string_view name, std::string_view type, std::string_view help) {
    name_ = fmt::format("laneloom_{}", name);
    fmt::format_to(std::back_inserter(text_), "# HELP {0} {1}\n# TYPE {0} {2}\n", name_, help, type);
  }
  template <class Number>
  void sample(Number value, const Labels& labels = {}) {
    text_ += name_;
    char before = '{';
    for (const auto& [label, label_value] : labels) {
      fmt::format_to(std::back_inserter(text_), "{}{}=\"{}\"", std::exchange(before, ','), label,
                     label_text(label_value));
    }
    fmt::format_to(std::back_inserter(text_), "{} {}\n", labels.empty() ? "" : "}", value);
  }
  template <class Number>
  void gauge(std::string_view name, std::string_view help, Number value) {
    family(name, "gauge", help);
    sample(value);
  }
  std::string take() { return std::move(text_); }

 private:
  std::string name_, text_;
};

void add_states(Text& text, const ServiceStatus& status) {
  text.family("state", "gauge", "1 for the state of the map.");
  for (const MapState state : {MapState::ok, MapState::degraded, MapState::stale})
    text.sample(state == status.state ? 1 : 0, {{"state", name(state)}});
  text.family("reason", "gauge", "1 for each reason why the map is not OK.");
  for (const StateReason reason : status.reasons) text.sample(1, {{"reason", name(reason)}});
}

void add_times(Text& text, std::string_view name, std::string_view help, const TimeSummary& time) {
  text.family(name, "gauge", help);
  const std::array<std::pair<const char*, double>, 4> values{
      {{"mean", time.mean_ms}, {"p50", time.p50_ms}, {"p99", time.p99_ms}, {"max", time.max_ms}}};
  for (const auto& [statistic, milliseconds] : values)
    text.sample(milliseconds / 1e3, {{"statistic", statistic}});
}

/// Adds one family with a value of each source.
template <class Value>
void add_sources(Text& text, const std::vector<SourceStatus>& sources, const Value& value) {
  for (const SourceStatus& source : sources)
    text.sample(value(source), {{"source", source.source}, {"session", std::to_string(source.session_id)}});
}

void add_sources(Text& text, const ServiceStatus& status) {
  text.family("source_frames_total", "counter",
              "Well-formed frames of a source that arrived, refused or not.");
  add_sources(text, status.sources, [](const SourceStatus& source) { return source.frames; });
  text.family("source_fused_total", "counter", "Frames of a source that went into the map.");
  add_sources(text, status.sources, [](const SourceStatus& source) { return source.fused; });
  text.family("source_lag_seconds", "gauge",
              "From a source's newest fused frame to the newest pose; -1: none yet.");
  add_sources(text, status.sources, [](const SourceStatus& source) { return source.lag_s; });
  text.family("source_learned", "gauge", "What the mapper has learned of a source's network.");
  for (const SourceStatus& source : status.sources)
    for (const auto& [what, value] : source.learned)
      text.sample(
          value, {{"source", source.source}, {"session", std::to_string(source.session_id)}, {"name", what}});
}

}  // namespace

std::string metrics(const ServiceStatus& status) {
  Text text;
  text.family("build_info", "gauge", "Version and configuration of the service.");
  text.sample(1, {{"version", status.version}, {"config_hash", status.config_hash}});
  add_states(text, status);
  text.gauge("uptime_seconds", "Since the service was started.", status.uptime_s);
  text.gauge("detections_age_seconds", "Since the newest detections arrived; -1: none yet.",
             status.detections_age_s);
  text.gauge("poses_age_seconds", "Since the newest pose arrived; -1: none yet.", status.poses_age_s);
  text.gauge("pending_frames", "Frames that wait for their poses.", status.pending_frames);
  add_times(text, "tick_seconds", "Work of a tick, of the last ten seconds.", status.tick);
  add_times(text, "tick_delay_seconds", "From a tick's deadline to its start, likewise.", status.tick_delay);
  text.family("events_total", "counter", "Counts since the service was started.");
  for (const auto& [counter, count] : status.counters) text.sample(count, {{"counter", counter}});
  add_sources(text, status);
  return text.take();
}

}  // namespace laneloom::view
