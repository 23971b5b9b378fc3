#include "core/service_core.hpp"

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>

#include "base/file_stamp.hpp"
#include "base/fnv.hpp"
#include "base/seconds.hpp"
#include "base/source_values.hpp"
#include "config/config_file.hpp"
#include "config/network_profile.hpp"
#include "laneloom/state_names.hpp"

namespace laneloom::core {
namespace {

constexpr double kSourceRemembered_s = 10.0;  // a source that is silent for longer is not missed any more
constexpr double kSourcePeriods = 2.5;        // a source may miss one of its frames
constexpr double kFusionShare = 0.5;  // share of a tick's period, after which no further frame is begun

/// Names the version and all of a configuration that maps depend on, with the files that it names. Two
/// services with the same name make the same maps of the same messages.
std::string maker_of_maps(Config config) {
  config.service = {};
  config.ros2 = {};
  const auto profiles = config::load_network_profiles(config.mapper.fusion.profile_file);
  const std::string files = config::dump(profiles) + file_stamp(config.sd_map.file);
  return std::string(version()) + " " + config::config_hash(config) + " " + std::to_string(fnv1a(files));
}

}  // namespace

const char* version() { return LANELOOM_VERSION; }

ServiceCore::ServiceCore(const Config& config, Surroundings surroundings)
    : config_(config),
      surroundings_(std::move(surroundings)),
      config_hash_(config::config_hash(config)),
      maker_(maker_of_maps(config)),
      session_id_(surroundings_.new_id()),
      map_id_(surroundings_.new_id()),
      started_ns_(surroundings_.steady_now_ns()),
      session_(config),
      health_(config.service),
      next_status_ns_(started_ns_),
      next_snapshot_ns_(started_ns_) {}

void ServiceCore::resume(snapshot::Snapshot&& snapshot) {
  session_.resume(snapshot.checkpoint, std::move(snapshot.state));
  map_id_ = snapshot.map_id;
}

snapshot::SnapshotStamp ServiceCore::snapshot_stamp() const {
  return {maker_, surroundings_.steady_now_ns(), surroundings_.system_now_ns()};
}

Messages ServiceCore::tick(const Tick& tick, Arrivals&& arrivals) {
  const std::int64_t taken_ns = surroundings_.steady_now_ns();
  fuse(tick, std::move(arrivals.messages));
  auto progress = session_.take_progress();
  note_incidents(tick, arrivals, progress);
  const HealthInputs now = inputs(taken_ns, arrivals);
  const Verdict verdict = health_.assess(taken_ns, now);

  Messages messages;
  messages.state_changed = std::exchange(verdict_, verdict) != verdict;
  messages.map = published_map(std::move(progress));
  messages.road_markings = {messages.map.map.stamp_ns, messages.map.sequence, session_id_,
                            messages.map.frame_id, messages.map.map.markings};
  messages.snapshot = snapshot_if_due(tick.start_ns);
  if (messages.state_changed || tick.start_ns >= next_status_ns_) messages.status = status(arrivals, now);
  if (tick.start_ns >= next_status_ns_) {
    next_status_ns_ = tick.start_ns + nanoseconds(config_.service.status_period_s);
  }
  return messages;
}

void ServiceCore::fuse(const Tick& tick, std::vector<Arrival>&& messages) {
  const std::int64_t end_ns =
      surroundings_.steady_now_ns() + nanoseconds(kFusionShare / config_.service.tick_rate_hz);
  session_.fuse_while([this, end_ns] { return surroundings_.steady_now_ns() < end_ns; });
  for (auto& [message, arrival_ns] : messages) {
    if (auto* frame = std::get_if<DetectionFrame>(&message)) {
      session_.add(std::move(*frame), arrival_ns);
    } else if (auto* objects = std::get_if<TrackedObjects>(&message)) {
      session_.add(std::move(*objects));
    } else if (const auto* turn = std::get_if<NextTurn>(&message)) {
      session_.add(*turn);
    } else {
      session_.add(std::get<VehiclePose>(message));
    }
  }
  session_.expire(tick.start_ns);
}

HealthInputs ServiceCore::inputs(std::int64_t now_ns, const Arrivals& arrivals) const {
  // Nobody shall drive on a map of a former run until a frame has confirmed it.
  const auto checkpoint = session_.checkpoint();
  const auto fused_ns = checkpoint ? std::optional(checkpoint->frame_arrival_ns) : std::nullopt;
  return {.detections_age_s = age_s(now_ns, arrivals.newest_frame_ns),
          .poses_age_s = age_s(now_ns, arrivals.newest_pose_ns),
          // The planner gets the map when the tick's work is done.
          .fused_age_s = age_s(surroundings_.steady_now_ns(), fused_ns),
          .other_service_age_s = age_s(now_ns, arrivals.other_service_ns),
          .lag_s = session_.lag_s(),
          .source_not_fused = source_not_fused(now_ns, arrivals),
          .sources_disagree = !session_.disagreements().empty(),
          .driving_side_contradicted = session_.mapper().driving_side_contradicted()};
}

bool ServiceCore::source_not_fused(std::int64_t now_ns, const Arrivals& arrivals) const {
  const auto crowded_out_ns = session_.crowded_out_ns();
  if (crowded_out_ns && age_s(now_ns, crowded_out_ns) < kSourceRemembered_s) return true;
  const auto is_fused = [&](const session::SourceProgress& source) {
    const double patience_s =
        std::max(config_.service.stale_after_s, kSourcePeriods * seconds(source.period_ns));
    return source.fused_arrival_ns && age_s(now_ns, source.fused_arrival_ns) <= patience_s;
  };
  std::set<std::string> heard, fused;
  for (std::size_t i = 0; i < arrivals.sources.size(); ++i)
    if (age_s(now_ns, arrivals.heard_ns[i]) < kSourceRemembered_s) heard.insert(arrivals.sources[i].source);
  for (const session::SourceProgress& source : session_.sources())
    if (is_fused(source)) fused.insert(source.source);
  return heard.size() > 1 && !std::ranges::includes(fused, heard);
}

void ServiceCore::note_incidents(const Tick& tick, const Arrivals& arrivals,
                                 const session::MappingSession::Progress& progress) {
  if (progress.pose_jumps > 0) health_.note_pose_jump(tick.start_ns);
  if (progress.resets > 0) {
    health_.note_reset(tick.start_ns);
    map_id_ = surroundings_.new_id();
  }
  const auto unsynchronised = session_.counters()["detections_refused_unsynchronised"];
  if (unsynchronised > std::exchange(unsynchronised_seen_, unsynchronised)) {
    health_.note_unsynchronised(tick.start_ns);
  }
  counters_.add("ticks");
  counters_.add("ticks_missed", tick.missed);
  counters_.add("ticks_out_of_time", session_.ready() > 0 ? 1 : 0);
  const auto overload = counters_["ticks_missed"] + counters_["ticks_out_of_time"] +
                        session_.counters()["frames_dropped_queue_full"] +
                        arrivals.counters["frames_dropped_queue_full"] +
                        arrivals.counters["poses_dropped_queue_full"] + arrivals.counters["frames_thinned"];
  if (overload > std::exchange(overload_seen_, overload)) health_.note_overload(tick.start_ns);
}

PublishedMap ServiceCore::published_map(session::MappingSession::Progress&& progress) {
  PublishedMap map;
  map.sequence = map_sequence_++;
  map.session_id = session_id_;
  map.frame_id = config_.dds.map_frame_id;
  map.published_ns = surroundings_.system_now_ns();
  map.map_id = map_id_;
  map.age_s = age_s(surroundings_.steady_now_ns(), session_.newest_arrival_ns());
  map.lag_s = session_.lag_s().value_or(-1.0);
  map.state = verdict_.state;
  map.reasons = verdict_.reasons;
  map.fused_frames = std::move(progress.fused);
  map.map = session_.map();
  map.map.lineage = std::move(progress.lineage);
  return map;
}

ServiceStatus ServiceCore::status(const Arrivals& arrivals, const HealthInputs& inputs) {
  ServiceStatus status;
  status.sequence = status_sequence_++;
  status.session_id = session_id_;
  status.published_ns = surroundings_.system_now_ns();
  status.state = verdict_.state;
  status.reasons = verdict_.reasons;
  status.uptime_s = age_s(surroundings_.steady_now_ns(), started_ns_);
  status.detections_age_s = inputs.detections_age_s;
  status.poses_age_s = inputs.poses_age_s;
  status.pending_frames = static_cast<std::uint32_t>(session_.pending());
  auto counters = arrivals.counters;
  counters.add(session_.counters());
  counters.add(counters_);
  status.counters.assign(counters.values().begin(), counters.values().end());
  status.sources = arrivals.sources;
  for (SourceStatus& source : status.sources) add_progress(source);
  status.version = version();
  status.config_hash = config_hash_;
  status.configuration = config::settings(config_);
  return status;
}

void ServiceCore::add_progress(SourceStatus& source) const {
  const auto all = session_.sources();
  const auto found = std::ranges::find_if(all, [&](const session::SourceProgress& progress) {
    return progress.source == source.source && progress.session_id == source.session_id;
  });
  if (found == all.end()) return;
  source.fused = found->fused;
  source.learned = session_.mapper().learned(source.source);
  for (const session::Disagreement& disagreement : session_.disagreements())
    if (disagreement.source == source.source)
      source.learned.emplace_back(std::string(kBesideSource) + disagreement.other, disagreement.beside_m);
  const auto lag_s = session_.lag_s();
  if (!found->fused_stamp_ns || !lag_s) return;
  source.lag_s = *lag_s + seconds(session_.map().stamp_ns - *found->fused_stamp_ns);
}

std::optional<snapshot::Snapshot> ServiceCore::snapshot_if_due(std::int64_t now_ns) {
  const auto checkpoint = session_.checkpoint();
  if (config_.service.snapshot_file.empty() || !checkpoint || now_ns < next_snapshot_ns_) return std::nullopt;
  next_snapshot_ns_ = now_ns + nanoseconds(config_.service.snapshot_period_s);
  return snapshot::Snapshot{snapshot_stamp(), map_id_, *checkpoint, session_.mapper_state()};
}

std::string ServiceCore::summary() const {
  return state_text(verdict_.state, verdict_.reasons) + ", " +
         std::to_string(session_.counters()["frames_fused"]) + " frames fused, " +
         std::to_string(session_.map().lanes.size()) + " lanes";
}

}  // namespace laneloom::core
