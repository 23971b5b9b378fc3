#include <algorithm>

#include "cdr/convert.hpp"
#include "cdr/convert_parts.hpp"

namespace laneloom::dds {
namespace {

msg::TimeSummary to_msg(const TimeSummary& from) {
  msg::TimeSummary to;
  to.mean_ms(from.mean_ms);
  to.p50_ms(from.p50_ms);
  to.p99_ms(from.p99_ms);
  to.max_ms(from.max_ms);
  return to;
}

TimeSummary from_msg(const msg::TimeSummary& from, Intake& intake) {
  return {intake.number(from.mean_ms()), intake.number(from.p50_ms()), intake.number(from.p99_ms()),
          intake.number(from.max_ms())};
}

msg::SourceStatus to_msg(const SourceStatus& from) {
  msg::SourceStatus to;
  ToMessage().put(from.source, to.source());
  to.session_id(from.session_id);
  to.first_sequence(from.first_sequence);
  to.last_sequence(from.last_sequence);
  to.frames(from.frames);
  to.fused(from.fused);
  to.lag_s(from.lag_s);
  to.learned().clear();
  for (const auto& [name, value] : from.learned) {
    if (to.learned().size() == msg::MAX_VALUES) break;
    msg::NamedValue learned;
    ToMessage().put(name, learned.name());
    learned.value(value);
    to.learned().push_back(learned);
  }
  return to;
}

SourceStatus from_msg(const msg::SourceStatus& from, Intake& intake) {
  SourceStatus to;
  to.source = from.source().to_string();
  to.session_id = from.session_id();
  to.first_sequence = from.first_sequence();
  to.last_sequence = from.last_sequence();
  to.frames = from.frames();
  to.fused = from.fused();
  to.lag_s = intake.number(from.lag_s());
  for (const auto& learned : from.learned())
    to.learned.emplace_back(learned.name().to_string(), intake.number(learned.value()));
  return to;
}

}  // namespace

std::size_t to_msg(const ServiceStatus& from, const std::string& /*map_frame_id*/, msg::ServiceStatus& to) {
  to.header(header_to_msg(from.published_ns, from.sequence, from.session_id, ""));
  ToMessage().put(from.state, to.state());
  ToMessage().put(from.reasons, to.reasons());
  to.uptime_s(from.uptime_s);
  to.detections_age_s(from.detections_age_s);
  to.poses_age_s(from.poses_age_s);
  to.tick(to_msg(from.tick));
  to.tick_delay(to_msg(from.tick_delay));
  to.pending_frames(from.pending_frames);
  to.counters().clear();
  for (const auto& [name, value] : from.counters) {
    if (to.counters().size() == msg::MAX_COUNTERS) break;
    msg::Counter counter;
    ToMessage().put(name, counter.name());
    counter.value(value);
    to.counters().push_back(counter);
  }
  const std::size_t sources = std::min<std::size_t>(from.sources.size(), msg::MAX_SOURCES);
  to.sources().clear();
  for (std::size_t i = from.sources.size() - sources; i < from.sources.size(); ++i) {
    to.sources().push_back(to_msg(from.sources[i]));
  }
  ToMessage().put(from.version, to.version());
  ToMessage().put(from.config_hash, to.config_hash());
  to.configuration().clear();
  for (const auto& [key, value] : from.configuration) {
    if (to.configuration().size() == msg::MAX_SETTINGS) break;
    msg::Setting setting;
    ToMessage().put(key, setting.key());
    ToMessage().put(value, setting.value());
    to.configuration().push_back(setting);
  }
  return from.counters.size() - to.counters().size() + from.sources.size() - sources +
         from.configuration.size() - to.configuration().size();
}

Refusal from_msg(const msg::ServiceStatus& from, const std::string& /*map_frame_id*/, ServiceStatus& to) {
  Intake intake;
  to.published_ns = from.header().stamp_ns();
  to.sequence = from.header().sequence_number();
  to.session_id = from.header().session_id();
  intake.take(from.state(), to.state);
  intake.take(from.reasons(), to.reasons);
  to.uptime_s = intake.number(from.uptime_s());
  to.detections_age_s = intake.number(from.detections_age_s());
  to.poses_age_s = intake.number(from.poses_age_s());
  to.tick = from_msg(from.tick(), intake);
  to.tick_delay = from_msg(from.tick_delay(), intake);
  to.pending_frames = from.pending_frames();
  to.counters.clear();
  for (const auto& counter : from.counters())
    to.counters.emplace_back(counter.name().to_string(), counter.value());
  to.sources.clear();
  for (const auto& source : from.sources()) to.sources.push_back(from_msg(source, intake));
  to.version = from.version().to_string();
  to.config_hash = from.config_hash().to_string();
  to.configuration.clear();
  for (const auto& setting : from.configuration())
    to.configuration.emplace_back(setting.key().to_string(), setting.value().to_string());
  return intake.refusal();
}

}  // namespace laneloom::dds
