#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "laneloom/types.hpp"

/// What the service publishes, as plain data; idl/ says what each field means on the wire.
namespace laneloom {

/// The state tells whether a planner may drive on the map: yes; with the reasons in mind; no.
enum class MapState : std::uint8_t { ok, degraded, stale };

/// Why a map is not OK; idl/Common.idl says what each means.
enum class StateReason : std::uint8_t {
  no_detections,
  no_poses,
  unsynchronised,
  starting,
  reset,
  overloaded,
  another_service,
  outdated,
  source_not_fused
};

/// Names one detection frame that went into the map.
struct FusedFrame {
  std::string source;
  std::uint64_t session_id = 0;
  std::uint64_t sequence = 0;
  std::int64_t stamp_ns = 0;
};

/// Topic lane_map. `map.markings` goes out on road_markings.
struct PublishedMap {
  std::uint64_t sequence = 0;
  std::uint64_t session_id = 0;
  std::string frame_id;           ///< of all coordinates
  std::int64_t published_ns = 0;  ///< system clock of the service's host
  std::uint64_t map_id = 0;       ///< ids of elements are valid while it stays
  double age_s = -1.0;            ///< since the newest fused frame's arrival; -1: none yet
  double lag_s = -1.0;            ///< from the newest fused frame's stamp to the newest pose's; -1: none yet
  MapState state = MapState::stale;
  std::vector<StateReason> reasons;
  std::vector<FusedFrame> fused_frames;  ///< since the map before
  LocalMap map;
};

/// Topic road_markings: the fused markings of the lane map with the same sequence.
struct RoadMarkings {
  std::int64_t stamp_ns = 0;
  std::uint64_t sequence = 0;
  std::uint64_t session_id = 0;
  std::string frame_id;
  std::vector<Marking> markings;
};

/// Times that something took, over the last ten seconds.
struct TimeSummary {
  double mean_ms = 0.0;
  double p50_ms = 0.0;
  double p99_ms = 0.0;
  double max_ms = 0.0;
};

/// The progress of one session of a source of detections.
struct SourceStatus {
  std::string source;
  std::uint64_t session_id = 0;
  std::uint64_t first_sequence = 0;
  std::uint64_t last_sequence = 0;  ///< the largest
  std::uint64_t frames = 0;         ///< valid ones that arrived
  std::uint64_t fused = 0;          ///< of these
  double lag_s = -1.0;  ///< from its newest fused frame's stamp to the newest pose's; -1: none yet
  std::vector<std::pair<std::string, double>> learned;  ///< of its network: name, value
};

/// Topic status.
struct ServiceStatus {
  std::uint64_t sequence = 0;
  std::uint64_t session_id = 0;
  std::int64_t published_ns = 0;
  MapState state = MapState::stale;
  std::vector<StateReason> reasons;
  double uptime_s = 0.0;
  double detections_age_s = -1.0;
  double poses_age_s = -1.0;
  TimeSummary tick;
  TimeSummary tick_delay;
  std::uint32_t pending_frames = 0;
  std::vector<std::pair<std::string, std::uint64_t>> counters;  ///< name, count
  std::vector<SourceStatus> sources;
  std::string version;
  std::string config_hash;
  std::vector<std::pair<std::string, std::string>> configuration;  ///< key, value
};

}  // namespace laneloom
