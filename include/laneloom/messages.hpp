#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "laneloom/types.hpp"

/// The messages that the service publishes, as plain data; idl/ says what each field means on the wire.
namespace laneloom {

/// How far the map is to be trusted. `ok`: fresh and complete; `degraded`: usable, with the reasons in mind;
/// `stale`: not to drive on.
enum class MapState : std::uint8_t { ok, degraded, stale };

/// Why a map is not OK.
enum class StateReason : std::uint8_t {
  no_detections,             ///< none arrived for longer than configured
  no_poses,                  ///< none arrived for longer than configured
  unsynchronised,            ///< frames arrive that are not fused; the counters say why
  starting,                  ///< nothing was fused yet
  reset,                     ///< the map was cleared a moment ago, after a jump of pose or stamp
  overloaded,                ///< frames were dropped, or a tick missed its deadline
  another_service,           ///< one more service publishes maps for the same vehicle
  outdated,                  ///< the fused frames are far older than the poses, by their stamps
  source_not_fused,          ///< one of several sources of detections is no longer fused
  sources_disagree,          ///< two sources contradict each other by more than their deviations
  poses_jumped,              ///< the poses jumped by less than the gate refuses; the map was moved or cleared
  driving_side_contradicted  ///< traffic keeps to the other side than the configuration says
};

/// Names one detection frame that went into the map.
struct FusedFrame {
  std::string source;            ///< the perception stack that sent it
  std::uint64_t session_id = 0;  ///< of the source's run
  std::uint64_t sequence = 0;    ///< counts per source and session
  std::int64_t stamp_ns = 0;     ///< sensor clock
};

/// Topic lane_map. `map.markings` is published on the topic road_markings instead.
struct PublishedMap {
  std::uint64_t sequence = 0;     ///< counts up by one per message
  std::uint64_t session_id = 0;   ///< of the service's run; another value means that it was restarted
  std::string frame_id;           ///< the frame that all coordinates are in
  std::int64_t published_ns = 0;  ///< system clock of the service's host
  std::uint64_t map_id = 0;       ///< ids of elements are valid while it stays
  double age_s = -1.0;            ///< since the newest fused frame's arrival; -1: none yet
  double lag_s = -1.0;            ///< from the newest fused frame's stamp to the newest pose's; -1: none yet
  MapState state = MapState::stale;
  std::vector<StateReason> reasons;      ///< empty where the state is ok
  std::vector<FusedFrame> fused_frames;  ///< since the map before, in the order of fusion
  LocalMap map;                          ///< in the frame `frame_id`
};

/// Whether a planner may drive on the map: it is not stale, and no second service writes maps in turn with
/// its own, whose ids are unrelated.
inline bool may_drive_on(const PublishedMap& map) {
  return map.state != MapState::stale &&
         std::ranges::find(map.reasons, StateReason::another_service) == map.reasons.end();
}

/// Topic road_markings: the fused markings of the lane map with the same sequence.
struct RoadMarkings {
  std::int64_t stamp_ns = 0;      ///< of the newest fused frame; 0: none yet
  std::uint64_t sequence = 0;     ///< of the lane map that the markings belong to
  std::uint64_t session_id = 0;   ///< of the service's run
  std::string frame_id;           ///< the frame that all coordinates are in
  std::vector<Marking> markings;  ///< of all types
};

/// Times that something took, over the last ten seconds.
struct TimeSummary {
  double mean_ms = 0.0;
  double p50_ms = 0.0;  ///< median
  double p99_ms = 0.0;  ///< 99 % took at most this long
  double max_ms = 0.0;
};

/// The progress of one session of a source of detections.
struct SourceStatus {
  std::string source;                ///< the perception stack that sends the detections
  std::uint64_t session_id = 0;      ///< of the source's run
  std::uint64_t first_sequence = 0;  ///< the smallest number of a frame that arrived
  std::uint64_t last_sequence = 0;   ///< the largest
  std::uint64_t frames = 0;          ///< number of well-formed frames that arrived, refused or not
  std::uint64_t fused = 0;           ///< number of frames that went into the map
  double lag_s = -1.0;  ///< from its newest fused frame's stamp to the newest pose's; -1: none yet
  /// Values that the mapper learned of the source's network: name, value.
  std::vector<std::pair<std::string, double>> learned;
};

/// Topic status: the health of the service.
struct ServiceStatus {
  std::uint64_t sequence = 0;     ///< counts up by one per message
  std::uint64_t session_id = 0;   ///< of the service's run
  std::int64_t published_ns = 0;  ///< system clock of the service's host
  MapState state = MapState::stale;
  std::vector<StateReason> reasons;  ///< empty where the state is ok
  double uptime_s = 0.0;             ///< since the service was started
  double detections_age_s = -1.0;    ///< since the newest detections arrived; -1: none yet
  double poses_age_s = -1.0;         ///< since the newest pose arrived; -1: none yet
  TimeSummary tick;                  ///< work of a tick, until the map is handed to DDS
  TimeSummary tick_delay;            ///< from a tick's deadline to its start
  std::uint32_t pending_frames = 0;  ///< number of frames that wait for their pose
  std::vector<std::pair<std::string, std::uint64_t>> counters;  ///< since the start: name, count
  std::vector<SourceStatus> sources;  ///< the sessions heard last, in the order of their beginning
  std::string version;                ///< of laneloom
  std::string config_hash;            ///< tells configurations apart
  /// Every key of the configuration, and its value as in the file.
  std::vector<std::pair<std::string, std::string>> configuration;
};

}  // namespace laneloom
