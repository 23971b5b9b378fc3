#include "session/mapping_session.hpp"

#include <algorithm>
#include <string>
#include <type_traits>
#include <utility>

#include "base/seconds.hpp"
#include "config/network_profile.hpp"
#include "mapping/state.hpp"
#include "mapping/trails/vehicles.hpp"
#include "sd_map/osm.hpp"
#include "session/admission.hpp"
#include "session/gate.hpp"
#include "session/pending_messages.hpp"
#include "session/sensor_offsets.hpp"
#include "session/source_agreement.hpp"
#include "session/sources.hpp"
#include "session/synchroniser.hpp"

namespace laneloom::session {
namespace {

using Checkpoint = MappingSession::Checkpoint;

StreamPoint place(const VehiclePose& pose) {
  return {pose.stamp_ns, pose.session_id, pose.position, pose.orientation};
}
StreamPoint place(const Checkpoint& checkpoint) {
  return {checkpoint.pose_stamp_ns, checkpoint.pose_session_id, checkpoint.position, checkpoint.orientation};
}

MapperConfig with_profiles(MapperConfig config) {
  for (auto& [source, profile] : config::load_network_profiles(config.fusion.profile_file))
    config.networks[source] = std::move(profile);
  return config;
}

std::string_view reason(Gate::Verdict verdict) {
  switch (verdict) {
    case Gate::Verdict::repeated:
      return "repeated";
    case Gate::Verdict::late:
      return "late";
    case Gate::Verdict::outlier:
      return "outlier";
    case Gate::Verdict::accepted:
    case Gate::Verdict::begins_anew:
    case Gate::Verdict::corrects:
      break;
  }
  return {};
}

}  // namespace

struct MappingSession::State {
  explicit State(const Config& c) : State(c, with_profiles(c.mapper)) {}
  /// `mapper_config` has the profiles of the networks.
  State(const Config& c, MapperConfig mapper_config)
      : gate_config(c.gate),
        max_pause_s(c.service.snapshot_max_age_s),
        pose_gate(c.gate, true),
        sources(c.gate),
        agreement(c.mapper),
        offsets(mapper_config.networks),
        synchroniser(c.sync),
        pending_objects(c),
        pending_turns(c),
        mapper(mapper_config, sd_map::load_sd_map(c.sd_map)) {}

  std::string_view add(const VehiclePose& pose);
  std::string_view add(DetectionFrame&& frame, std::int64_t arrival_ns);
  /// Keeps a message of `kind`, "objects" or "next_turns", until its frame comes.
  template <class T>
  void add(T message, const std::string& kind, PendingMessages<T>& pending);
  /// Whether a pose may follow `before`, after a pause of the poses or the service of at most `max_pause_s`.
  bool goes_on(const VehiclePose& pose, const StreamPoint& before) const {
    return follows(place(pose), before, gate_config, gate_config.max_stamp_step_s + max_pause_s);
  }
  void check_resumed(const VehiclePose& pose);
  void fuse_ready();
  void fuse(const SynchronisedFrame& synchronised);
  template <class T>
  void take_until(std::int64_t stamp_ns, const std::string& kind, PendingMessages<T>& pending);
  void reset();
  /// A counter appears with its first count.
  void count(const std::string& counter, std::size_t rise) {
    if (rise > 0) counters.add(counter, rise);
  }
  /// `kind` is detections, poses, objects or next_turns.
  void refuse(const std::string& kind, std::string_view why, std::size_t number = 1) {
    count(kind + "_refused_" + std::string(why), number);
  }
  void count_moving(const TrackedObjects& objects);

  GateConfig gate_config;
  double max_pause_s;
  Gate pose_gate;
  Sources sources;
  SourceAgreement agreement;
  SensorOffsets offsets;
  Synchroniser synchroniser;
  PendingMessages<TrackedObjects> pending_objects;
  PendingMessages<NextTurn> pending_turns;
  Mapper mapper;
  std::optional<std::int64_t> newest_stamp_ns;
  std::optional<std::int64_t> newest_arrival_ns;
  std::optional<VehiclePose> newest_pose;
  std::optional<Checkpoint> resumed;  ///< the checkpoint, until the first pose came
  std::function<bool()> may_go_on;    ///< empty: there is no limit
  bool has_begun = false;             ///< a frame was fused since the limit was set
  Counters counters;
  Progress progress;
  StageObserver* observer = nullptr;
  std::function<void(const FusedFrame&, const LocalMap&)> map_observer;
};

std::string_view MappingSession::State::add(const VehiclePose& pose) {
  if (const auto found = defect(pose, gate_config); !found.empty()) return found;
  const auto verdict = pose_gate.check(place(pose));
  if (const auto why = reason(verdict); !why.empty()) return why;
  if (verdict == Gate::Verdict::begins_anew) {
    // Poses that only paused are still those of the map.
    if (!goes_on(pose, place(*newest_pose))) reset();
    synchroniser.clear_poses();
  }
  if (verdict == Gate::Verdict::corrects) synchroniser.drop_poses_from(pose.stamp_ns);
  check_resumed(pose);
  counters.add("poses_accepted");
  newest_pose = pose;
  synchroniser.add(pose);
  fuse_ready();
  return {};
}

void MappingSession::State::check_resumed(const VehiclePose& pose) {
  if (resumed && !goes_on(pose, place(*resumed))) reset();
  resumed.reset();
}

std::string_view MappingSession::State::add(DetectionFrame&& frame, std::int64_t arrival_ns) {
  if (const auto found = defect(frame, gate_config); !found.empty()) return found;
  const Sources::Verdict verdict = sources.check(frame, arrival_ns);
  if (!verdict.refusal.empty()) return verdict.refusal;
  if (verdict.restarted) counters.add("sources_restarted");
  offsets.apply(frame);
  if (const auto left_out = admit(gate_config, frame); left_out > 0) {
    counters.add("frames_thinned");
    counters.add("detections_left_out", left_out);
  }
  synchroniser.add(PendingFrame{std::move(frame), arrival_ns});
  fuse_ready();
  if (const auto dropped = synchroniser.drop_excess()) counters.add("frames_dropped_queue_full", dropped);
  return {};
}

template <class T>
void MappingSession::State::add(T message, const std::string& kind, PendingMessages<T>& pending) {
  std::string_view refusal = defect(message, gate_config);
  const auto newest_pose_ns = newest_pose ? std::optional(newest_pose->stamp_ns) : std::nullopt;
  if (refusal.empty()) refusal = pending.add(std::move(message), newest_pose_ns);
  if (!refusal.empty()) refuse(kind, refusal);
  count(kind + "_dropped_queue_full", pending.drop_excess());
}

/// Hands the messages until a stamp to the mapper. The poses until there have come.
template <class T>
void MappingSession::State::take_until(std::int64_t stamp_ns, const std::string& kind,
                                       PendingMessages<T>& pending) {
  Eigen::Isometry3d T_map_body;
  while (const auto message = pending.take_until(stamp_ns)) {
    if (synchroniser.pose_at(message->stamp_ns, T_map_body) != PoseBuffer::Answer::found) {
      refuse(kind, "unsynchronised");
      continue;
    }
    mapper.add(*message, T_map_body);
    counters.add(kind + "_fused");
    if constexpr (std::is_same_v<T, TrackedObjects>) count_moving(*message);
  }
}

/// Counts the objects that may leave trails, and those that do not though they move.
void MappingSession::State::count_moving(const TrackedObjects& objects) {
  const trails::MovingObjects moving = trails::moving_objects(objects);
  count("objects_believed", moving.believed);
  count("objects_without_heading", moving.without_heading);
  count("objects_doubted", moving.doubted);
}

void MappingSession::State::fuse_ready() {
  std::size_t unsynchronised = 0;
  while (!may_go_on || !has_begun || may_go_on()) {
    const auto frame = synchroniser.next(unsynchronised);
    if (!frame) break;
    has_begun = true;
    fuse(*frame);
  }
  refuse("detections", "unsynchronised", unsynchronised);
}

void MappingSession::State::fuse(const SynchronisedFrame& synchronised) {
  const auto& frame = synchronised.pending.frame;
  if (!agreement.may_fuse(frame, synchronised.T_map_body, synchronised.pending.arrival_ns)) {
    refuse("detections", "contradictory");
    return;
  }
  take_until(frame.stamp_ns, "objects", pending_objects);
  take_until(frame.stamp_ns, "next_turns", pending_turns);
  const auto& map = mapper.update(frame, synchronised.T_map_body, observer);
  newest_stamp_ns = map.stamp_ns;
  newest_arrival_ns = synchronised.pending.arrival_ns;
  sources.note_fused(frame, synchronised.pending.arrival_ns);
  counters.add("frames_fused");
  if (mapper.poses_jumped()) {
    agreement.forget();
    counters.add("pose_jumps");
    ++progress.pose_jumps;
  }
  count("detections_zigzagging", mapper.detections_zigzagging());
  count("detections_unsure", mapper.detections_unsure());
  count("lines_forgotten", mapper.lines_forgotten());
  progress.fused.push_back({frame.source, frame.session_id, frame.sequence, frame.stamp_ns});
  if (map_observer) map_observer(progress.fused.back(), map);
  progress.lineage.insert(progress.lineage.end(), map.lineage.begin(), map.lineage.end());
}

/// Forgets the map, and the frames that belong to it.
void MappingSession::State::reset() {
  refuse("detections", "reset", synchroniser.clear_frames());
  refuse("objects", "reset", pending_objects.clear());
  refuse("next_turns", "reset", pending_turns.clear());
  mapper.reset();
  agreement.forget();
  progress.lineage.clear();  // it tells of ids of the old map
  newest_stamp_ns.reset();
  newest_arrival_ns.reset();
  counters.add("map_resets");
  ++progress.resets;
}

MappingSession::MappingSession(const Config& config) : state_(std::make_unique<State>(config)) {}
MappingSession::~MappingSession() = default;
MappingSession::MappingSession(MappingSession&&) noexcept = default;
MappingSession& MappingSession::operator=(MappingSession&&) noexcept = default;

void MappingSession::add(const VehiclePose& pose) {
  const auto why = state_->add(pose);
  if (!why.empty()) state_->refuse("poses", why);
}

void MappingSession::add(DetectionFrame frame, std::int64_t arrival_ns) {
  const auto why = state_->add(std::move(frame), arrival_ns);
  if (!why.empty()) state_->refuse("detections", why);
}

void MappingSession::add(TrackedObjects objects) {
  state_->add(std::move(objects), "objects", state_->pending_objects);
}

void MappingSession::add(NextTurn turn) { state_->add(turn, "next_turns", state_->pending_turns); }

void MappingSession::expire(std::int64_t now_ns) {
  state_->refuse("detections", "unsynchronised", state_->synchroniser.expire(now_ns));
}

void MappingSession::fuse_while(std::function<bool()> may_go_on) {
  state_->may_go_on = std::move(may_go_on);
  state_->has_begun = false;
  state_->fuse_ready();
}

std::vector<SourceProgress> MappingSession::sources() const { return state_->sources.progress(); }

std::vector<Disagreement> MappingSession::disagreements() const { return state_->agreement.disagreements(); }

std::optional<std::int64_t> MappingSession::crowded_out_ns() const {
  return state_->sources.crowded_out_ns();
}

std::optional<double> MappingSession::lag_s() const {
  const State& state = *state_;
  if (!state.newest_stamp_ns || !state.newest_pose) return std::nullopt;
  return seconds(state.newest_pose->stamp_ns - *state.newest_stamp_ns);
}

MappingSession::Progress MappingSession::take_progress() { return std::exchange(state_->progress, {}); }

std::optional<MappingSession::Checkpoint> MappingSession::checkpoint() const {
  const State& state = *state_;
  if (!state.newest_stamp_ns || state.counters["frames_fused"] == 0) return std::nullopt;
  return Checkpoint{*state.newest_stamp_ns,      *state.newest_arrival_ns,
                    state.newest_pose->stamp_ns, state.newest_pose->session_id,
                    state.newest_pose->position, state.newest_pose->orientation};
}

void MappingSession::resume(const Checkpoint& checkpoint, MapperState state) {
  state.ids.leave_out_unknown();
  MapperState::give(std::move(state), state_->mapper);
  state_->newest_stamp_ns = checkpoint.frame_stamp_ns;
  state_->newest_arrival_ns = checkpoint.frame_arrival_ns;
  state_->resumed = checkpoint;
}

const LocalMap& MappingSession::map() const { return state_->mapper.map(); }
Mapper& MappingSession::mapper() { return state_->mapper; }
const Mapper& MappingSession::mapper() const { return state_->mapper; }
const MapperState& MappingSession::mapper_state() const { return MapperState::of(state_->mapper); }
std::size_t MappingSession::pending() const { return state_->synchroniser.pending(); }
std::size_t MappingSession::ready() const { return state_->synchroniser.ready(); }
std::optional<std::int64_t> MappingSession::newest_arrival_ns() const { return state_->newest_arrival_ns; }
const Counters& MappingSession::counters() const { return state_->counters; }
void MappingSession::observe(StageObserver* observer) { state_->observer = observer; }
void MappingSession::observe(std::function<void(const FusedFrame&, const LocalMap&)> observer) {
  state_->map_observer = std::move(observer);
}

}  // namespace laneloom::session
