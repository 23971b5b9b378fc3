#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/tick_log.hpp"
#include "laneloom/config.hpp"
#include "laneloom/messages.hpp"

/// How long maps take to their readers: laneloomd, `laneloom publish`, and a reader in this process, joined
/// by real DDS. All times are the system clock's of the one host that they run on.
namespace laneloom {

struct LatencySpec {
  std::filesystem::path service;    ///< the program laneloomd
  std::filesystem::path publisher;  ///< the program laneloom
  DdsConfig dds;
  std::filesystem::path identities;  ///< of tools/make-certificates; empty: without security
  std::string scenario, noise;
  double speed_mps = 10.0;
  double duration_s = 30.0;   ///< that is measured
  unsigned busy_threads = 0;  ///< of this process, that do nothing but keep a core busy
  std::size_t viewers = 0;    ///< that read from a `laneloom view`, which runs beside; 0: it does not run
};

/// What `laneloom view` took while it was read.
struct ViewerCost {
  double cpu_percent = 0.0;   ///< of one core
  double peak_rss_mb = 0.0;   ///< MiB
  double frames_per_s = 0.0;  ///< that each of its readers got, in the mean
};

/// A map as it came.
struct ReceivedMap {
  std::uint64_t sequence = 0;
  std::int64_t published_ns = 0;            ///< as the map says it
  std::int64_t callback_ns = 0;             ///< when the reader's callback was called with it
  std::vector<std::uint64_t> fused_frames;  ///< sequences of the detections that it contains first
};

struct LatencyResult {
  std::uint64_t ticks = 0;
  std::uint64_t missed_deadlines = 0;
  std::uint64_t maps_lost = 0;          ///< ticks whose map did not come
  TimeSummary tick_delay;               ///< from a tick's deadline to its start
  TimeSummary tick_to_callback;         ///< from a tick's start to the reader's callback with its map
  TimeSummary publication_to_callback;  ///< of it, from the map's published_ns on: writing and transport
  TimeSummary detections_to_callback;   ///< from a frame's publication to the callback with its first map
  std::uint64_t frames = 0;             ///< whose first map came
  double service_cpu_percent = 0.0;     ///< of one core
  double service_peak_rss_mb = 0.0;     ///< MiB
  std::optional<ViewerCost> viewer;     ///< where there were readers of it
};

/// Puts together what the three processes wrote down. `published` has the detections' times by sequence; CPU
/// and memory stay 0.
LatencyResult latencies(const std::vector<LoggedTick>& ticks, const std::vector<ReceivedMap>& maps,
                        const std::map<std::uint64_t, std::int64_t>& published);

/// Throws std::runtime_error where a process cannot be started or ends by itself, or no map comes.
LatencyResult measure_latency(const LatencySpec& spec);

}  // namespace laneloom
