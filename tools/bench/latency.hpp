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

/// Measures how long maps take to their readers. laneloomd, `laneloom publish`, and a reader in this process
/// are joined by real DDS. All times are by the system clock of the one host that they run on.
namespace laneloom::bench {

/// The processes and the load of a measurement.
struct LatencySpec {
  std::filesystem::path service;    ///< the program laneloomd
  std::filesystem::path publisher;  ///< the program laneloom
  DdsConfig dds;
  std::filesystem::path identities;  ///< of tools/make-certificates; empty: without security
  std::string scenario, noise;
  double speed_mps = 10.0;
  double delay_spread_ms = 100.0;  ///< of the publisher's network: the longest delay minus the shortest
  double duration_s = 30.0;        ///< time that is measured
  unsigned busy_threads = 0;       ///< number of threads of this process that keep a core busy each
  std::size_t viewers = 0;  ///< number of readers of a `laneloom view` that runs beside; 0: it does not run
};

/// The cost of `laneloom view` while it was read.
struct ViewerCost {
  double cpu_percent = 0.0;   ///< of one core
  double peak_rss_mb = 0.0;   ///< MiB
  double frames_per_s = 0.0;  ///< mean over its readers
};

/// A map that a reader received.
struct ReceivedMap {
  std::uint64_t sequence = 0;
  std::int64_t published_ns = 0;            ///< by the map itself
  std::int64_t callback_ns = 0;             ///< call of the reader's callback
  std::vector<std::uint64_t> fused_frames;  ///< sequences of the detections that no map before contained
};

/// The result of a measurement.
struct LatencyResult {
  std::uint64_t ticks = 0;
  std::uint64_t missed_deadlines = 0;
  std::uint64_t maps_lost = 0;          ///< number of ticks whose map did not come
  TimeSummary tick_delay;               ///< from a tick's deadline to its start
  TimeSummary tick_to_callback;         ///< from a tick's start to the reader's callback with its map
  TimeSummary publication_to_callback;  ///< part of it from the map's published_ns on: writing and transport
  TimeSummary detections_to_callback;   ///< from a frame's publication to the callback with its first map
  std::uint64_t frames = 0;             ///< number of frames whose first map came
  double service_cpu_percent = 0.0;     ///< of one core
  double service_peak_rss_mb = 0.0;     ///< MiB
  std::optional<ViewerCost> viewer;     ///< none: it did not run
};

/// Computes the latencies from the records of the three processes. `published` has the detections' times by
/// sequence. CPU and memory stay 0.
LatencyResult latencies(const std::vector<LoggedTick>& ticks, const std::vector<ReceivedMap>& maps,
                        const std::map<std::uint64_t, std::int64_t>& published);

/// Measures the latencies. Throws std::runtime_error if a process cannot be started or ends by itself, or no
/// map comes.
LatencyResult measure_latency(const LatencySpec& spec);

}  // namespace laneloom::bench
