#include "service/service.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>
#include <variant>

#include "base/random_id.hpp"
#include "base/system_clock.hpp"
#include "config/config_file.hpp"
#include "laneloom/state_names.hpp"

namespace laneloom {
namespace {

constexpr double kStatisticsWindow_s = 10.0;
// Metres of markings that a tick fuses: a few of the dearest frames that the gate admits, and far more than
// perception sends.
constexpr double kTickWork_m = 6000.0;
constexpr double kSourceRemembered_s = 10.0;  // a source that ended, or took another name, is missed so long

/// Of counters that should not rise in normal operation.
bool is_incident(std::string_view counter) {
  return counter.find("_refused_") != std::string_view::npos ||
         counter.find("_dropped_") != std::string_view::npos || counter.ends_with("_lost") ||
         counter == "map_resets" || counter == "sources_restarted" || counter == "frames_thinned" ||
         counter == "ticks_missed" || counter == "elements_left_out" || counter == "writes_failed" ||
         counter == "snapshots_failed";
}

std::size_t ticks_within(double window_s, double rate_hz) {
  return static_cast<std::size_t>(std::ceil(window_s * rate_hz));
}

double milliseconds(std::int64_t duration_ns) { return static_cast<double>(duration_ns) / 1e6; }

}  // namespace

const char* version() { return LANELOOM_VERSION; }

Service::Service(const Config& config, std::function<std::int64_t()> now_ns)
    : config_(config),
      config_hash_(config_hash(config)),
      now_ns_(std::move(now_ns)),
      session_id_(random_id()),
      map_id_(random_id()),
      started_ns_(now_ns_()),
      session_(config),
      queue_(config),
      health_(config.service),
      work_(ticks_within(kStatisticsWindow_s, config.service.tick_rate_hz)),
      delay_(ticks_within(kStatisticsWindow_s, config.service.tick_rate_hz)),
      next_status_ns_(started_ns_),
      next_snapshot_ns_(started_ns_) {
  reopen();  // first, as a snapshot that is resumed is gone
  if (!config.service.snapshot_file.empty()) {
    resume();
    snapshots_ = std::make_unique<SnapshotWriter>(config.service.snapshot_file);
  }
}

SnapshotStamp Service::snapshot_stamp() const {
  Config of_the_map = config_;
  of_the_map.service = {};
  of_the_map.ros2 = {};
  return {std::string(version()) + " " + config_hash(of_the_map), now_ns_(), system_now_ns()};
}

void Service::resume() {
  const std::string& file = config_.service.snapshot_file;
  std::error_code unknown;
  if (!std::filesystem::exists(file, unknown) && !unknown) return;
  try {
    auto snapshot = read_snapshot(file, snapshot_stamp(), config_.service.snapshot_max_age_s, config_.mapper);
    session_.resume(snapshot.checkpoint, std::move(snapshot.state));
    map_id_ = snapshot.map_id;
    counters_.add("snapshots_resumed");
    spdlog::info("event=resumed file={} lanes={}", file, session_.map().lanes.size());
  } catch (const std::exception& error) {
    counters_.add("snapshots_refused");
    spdlog::warn("event=snapshot_refused file={} why=\"{}\"", file, error.what());
  }
  std::filesystem::remove(file, unknown);  // a map that ends the service does so once
}

void Service::keep_snapshot(std::int64_t now_ns) {
  const auto checkpoint = session_.checkpoint();
  if (!snapshots_ || !checkpoint || now_ns < next_snapshot_ns_) return;
  next_snapshot_ns_ = now_ns + static_cast<std::int64_t>(config_.service.snapshot_period_s * 1e9);
  snapshots_->write({snapshot_stamp(), map_id_, *checkpoint, session_.mapper().state()});
}

/// While there still are endpoints to go on with.
void Service::check_reopening() {
  dds::check_files(config_.dds);
  if (!endpoints_ || config_.dds.security_directory.empty()) return;
  try {
    const Endpoints trial(config_, session_id_, queue_, now_ns_, dds::Participant::Presence::hidden);
  } catch (const dds::NotPermitted& error) {
    throw ConfigError(error.what());
  }
}

void Service::reopen() {
  check_reopening();
  endpoints_.reset();  // before the new ones, or two services on one vehicle id would be seen
  endpoints_ = std::make_unique<Endpoints>(config_, session_id_, queue_, now_ns_);
}

void Service::tick(const Tick& tick) {
  ingest(tick.start_ns);
  auto progress = session_.take_progress();
  const bool changed = judge(tick, progress.resets);
  publish_map(std::move(progress));
  keep_snapshot(tick.start_ns);
  work_.add(milliseconds(now_ns_() - tick.start_ns));
  delay_.add(milliseconds(tick.start_ns - tick.deadline_ns));
  log_tick(tick);
  if (changed) spdlog::info("state={} session={}", state_text(verdict_.state, verdict_.reasons), session_id_);
  if (changed || tick.start_ns >= next_status_ns_) publish_status(tick.start_ns);
}

void Service::ingest(std::int64_t now_ns) {
  session_.grant_work(kTickWork_m);
  for (auto& [message, arrival_ns] : queue_.drain()) {
    if (auto* frame = std::get_if<DetectionFrame>(&message)) {
      session_.add(std::move(*frame), arrival_ns);
    } else {
      session_.add(std::get<VehiclePose>(message));
    }
  }
  session_.expire(now_ns);
}

bool Service::source_not_fused(std::int64_t now_ns) const {
  const auto crowded_out_ns = session_.crowded_out_ns();
  if (crowded_out_ns && age_s(now_ns, crowded_out_ns) < kSourceRemembered_s) return true;
  const auto sources = session_.sources();
  return sources.size() > 1 && std::ranges::any_of(sources, [&](const SourceProgress& source) {
           return age_s(now_ns, source.arrival_ns) < kSourceRemembered_s &&
                  (!source.fused_arrival_ns ||
                   age_s(now_ns, source.fused_arrival_ns) > config_.service.stale_after_s);
         });
}

// Benchmarks tell by it how long the map of a tick takes to its readers.
void Service::log_tick(const Tick& tick) const {
  if (!spdlog::should_log(spdlog::level::debug)) return;
  spdlog::debug("event=tick map={} start_ns={} delay_ns={} missed={}", map_sequence_ - 1,
                system_now_ns() - (now_ns_() - tick.start_ns), tick.start_ns - tick.deadline_ns, tick.missed);
}

bool Service::judge(const Tick& tick, std::uint64_t resets) {
  const auto arrived = queue_.snapshot();
  const auto unsynchronised = session_.counters()["detections_refused_unsynchronised"];
  const auto dropped = arrived.counters["frames_dropped_queue_full"] +
                       arrived.counters["poses_dropped_queue_full"] +
                       session_.counters()["frames_dropped_queue_full"] + arrived.counters["frames_thinned"];
  if (resets > 0) {
    health_.note_reset(tick.start_ns);
    map_id_ = random_id();
  }
  if (unsynchronised > std::exchange(unsynchronised_seen_, unsynchronised)) {
    health_.note_unsynchronised(tick.start_ns);
  }
  if (dropped > std::exchange(dropped_seen_, dropped) || tick.missed > 0)
    health_.note_overload(tick.start_ns);
  counters_.add("ticks");
  counters_.add("ticks_missed", tick.missed);

  // A map of before is none to drive on until a frame has confirmed it.
  const auto checkpoint = session_.checkpoint();
  const auto fused_ns = checkpoint ? std::optional(checkpoint->frame_arrival_ns) : std::nullopt;
  // Ages are taken now: what arrived since the tick's start has none that is negative.
  const auto now_ns = now_ns_();
  const auto verdict =
      health_.assess(now_ns, {arrived.newest_frame_ns, arrived.newest_pose_ns, fused_ns,
                              arrived.other_service_ns, session_.lag_s(), source_not_fused(now_ns)});
  return std::exchange(verdict_, verdict) != verdict;
}

template <class T>
void Service::write(dds::Writer<T>& writer, const T& message) {
  const auto before = writer.left_out();
  if (!writer.write(message)) counters_.add("writes_failed");
  counters_.add("elements_left_out", writer.left_out() - before);
}

void Service::publish_map(MappingSession::Progress&& progress) {
  PublishedMap map;
  map.sequence = map_sequence_++;
  map.session_id = session_id_;
  map.frame_id = config_.dds.map_frame_id;
  map.published_ns = system_now_ns();
  map.map_id = map_id_;
  map.age_s = age_s(now_ns_(), session_.newest_arrival_ns());
  map.lag_s = session_.lag_s().value_or(-1.0);
  map.state = verdict_.state;
  map.reasons = verdict_.reasons;
  map.fused_frames = std::move(progress.fused);
  map.map = session_.map();
  map.map.lineage = std::move(progress.lineage);
  write(endpoints_->map, map);
  if (endpoints_->ros2) counters_.add("writes_failed", endpoints_->ros2->write(map));
  write(endpoints_->road_markings, RoadMarkings{map.map.stamp_ns, map.sequence, map.session_id, map.frame_id,
                                                std::move(map.map.markings)});
}

void Service::publish_status(std::int64_t now_ns) {
  auto message = status();
  message.sequence = status_sequence_++;
  write(endpoints_->status, message);
  if (endpoints_->ros2) counters_.add("writes_failed", endpoints_->ros2->write(message));
  if (now_ns >= next_status_ns_) {
    next_status_ns_ = now_ns + static_cast<std::int64_t>(config_.service.status_period_s * 1e9);
    log_incidents(all_counters(queue_.snapshot()));
  }
}

ServiceStatus Service::status() const {
  const auto arrived = queue_.snapshot();
  const auto now_ns = now_ns_();  // after the arrivals
  ServiceStatus status;
  status.session_id = session_id_;
  status.published_ns = system_now_ns();
  status.state = verdict_.state;
  status.reasons = verdict_.reasons;
  status.uptime_s = age_s(now_ns, started_ns_);
  status.detections_age_s = age_s(now_ns, arrived.newest_frame_ns);
  status.poses_age_s = age_s(now_ns, arrived.newest_pose_ns);
  status.tick = work_.summary();
  status.tick_delay = delay_.summary();
  status.pending_frames = static_cast<std::uint32_t>(session_.pending() + arrived.queued_frames);
  const auto counters = all_counters(arrived);
  status.counters.assign(counters.values().begin(), counters.values().end());
  status.sources = arrived.sources;
  for (SourceStatus& source : status.sources) add_progress(source);
  status.version = version();
  status.config_hash = config_hash_;
  status.configuration = settings(config_);
  return status;
}

void Service::add_progress(SourceStatus& source) const {
  const auto all = session_.sources();
  const auto found = std::ranges::find_if(all, [&](const SourceProgress& progress) {
    return progress.source == source.source && progress.session_id == source.session_id;
  });
  if (found == all.end()) return;
  source.fused = found->fused;
  source.learned = session_.mapper().learned(source.source);
  const auto lag_s = session_.lag_s();
  if (!found->fused_stamp_ns || !lag_s) return;
  source.lag_s = *lag_s + static_cast<double>(session_.map().stamp_ns - *found->fused_stamp_ns) / 1e9;
}

Counters Service::all_counters(const IngestionQueue::Snapshot& arrived) const {
  auto all = arrived.counters;
  all.add(session_.counters());
  all.add(counters_);
  if (snapshots_) {
    const auto snapshots = snapshots_->totals();
    all.add("snapshots_written", snapshots.written);
    all.add("snapshots_failed", snapshots.failed);
  }
  return all;
}

// Once per status period, so that nothing that others send can flood the log.
void Service::log_incidents(const Counters& counters) {
  for (const auto& [counter, total] : counters.values()) {
    const auto before = reported_[counter];
    if (total <= before) continue;  // a message that was taken for lost may still come
    const auto rise = total - before;
    if (is_incident(counter)) spdlog::warn("counter={} new={} total={}", counter, rise, total);
  }
  reported_ = counters;
}

std::string Service::summary() const {
  return state_text(verdict_.state, verdict_.reasons) + ", " +
         std::to_string(session_.counters()["frames_fused"]) + " frames fused, " +
         std::to_string(session_.map().lanes.size()) + " lanes";
}

}  // namespace laneloom
