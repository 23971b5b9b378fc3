#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "laneloom/config.hpp"
#include "laneloom/messages.hpp"
#include "service/endpoints.hpp"
#include "service/executor.hpp"
#include "service/health.hpp"
#include "service/ingestion_queue.hpp"
#include "service/time_window.hpp"
#include "session/mapping_session.hpp"
#include "snapshot/snapshot_writer.hpp"

namespace laneloom {

/// The version of laneloom that this is.
const char* version();

/// What laneloomd does: takes what came, updates the map, and publishes, at every tick.
/// One thread calls it; the threads of DDS only reach its queue.
class Service {
 public:
  /// `now_ns` is a steady clock, callable from any thread. Throws ConfigError when a file that the
  /// configuration names is missing or invalid, and std::runtime_error when DDS can't be set up.
  Service(const Config& config, std::function<std::int64_t()> now_ns);

  void tick(const Tick& tick);
  /// Makes all DDS endpoints anew; the map and what is queued stay. Throws ConfigError, and keeps the
  /// endpoints that there are, when a file of the profile or of security is missing or invalid, or DDS does
  /// not believe it. After the std::runtime_error of a DDS that refuses, nothing else may be called.
  void reopen();

  /// State and numbers in one line, for people.
  std::string summary() const;

 private:
  void check_reopening();
  /// Goes on with the map of the service before, if it left one.
  void resume();
  void keep_snapshot(std::int64_t now_ns);
  SnapshotStamp snapshot_stamp() const;
  void ingest(std::int64_t now_ns);
  /// Sets the verdict; true when it changed.
  bool judge(const Tick& tick, std::uint64_t resets);
  void log_tick(const Tick& tick) const;
  void publish_map(MappingSession::Progress&& progress);
  void publish_status(std::int64_t now_ns);
  ServiceStatus status() const;
  void add_progress(SourceStatus& source) const;
  /// Whether one of several sources that was heard a moment ago does not go into the map.
  bool source_not_fused(std::int64_t now_ns) const;
  Counters all_counters(const IngestionQueue::Snapshot& arrived) const;
  void log_incidents(const Counters& counters);
  template <class T>
  void write(dds::Writer<T>& writer, const T& message);

  Config config_;
  std::string config_hash_;
  std::function<std::int64_t()> now_ns_;
  std::uint64_t session_id_;
  std::uint64_t map_id_;  ///< ids of elements are valid while it stays
  std::int64_t started_ns_;
  MappingSession session_;
  IngestionQueue queue_;
  Health health_;
  Verdict verdict_;
  TimeWindow work_;
  TimeWindow delay_;
  Counters counters_;  ///< of the service itself
  Counters reported_;  ///< as last logged
  std::uint64_t unsynchronised_seen_ = 0;
  std::uint64_t dropped_seen_ = 0;
  std::uint64_t map_sequence_ = 0;
  std::uint64_t status_sequence_ = 0;
  std::int64_t next_status_ns_;
  std::int64_t next_snapshot_ns_;
  std::unique_ptr<SnapshotWriter> snapshots_;  ///< null: none are kept
  std::unique_ptr<Endpoints> endpoints_;       ///< last: nothing calls into what is already gone
};

}  // namespace laneloom
