#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/service_core.hpp"
#include "laneloom/config.hpp"
#include "laneloom/counters.hpp"
#include "service/endpoints.hpp"
#include "service/incident_log.hpp"
#include "service/ingestion_queue.hpp"
#include "service/time_window.hpp"
#include "snapshot/snapshot_writer.hpp"

namespace laneloom::service {

/// Connects the core with DDS, files, clocks and the log. One thread calls it; the threads of DDS only reach
/// its queue.
class Service {
 public:
  /// `now_ns` is a steady clock, callable from any thread. `frame_is_ready` is as of IngestionQueue. Throws
  /// ConfigError when a file that the configuration names is missing or invalid, and std::runtime_error when
  /// DDS can't be set up.
  Service(const Config& config, std::function<std::int64_t()> now_ns, std::function<void()> frame_is_ready);

  void tick(const core::Tick& tick);
  /// As IngestionQueue::take_ready().
  std::vector<std::int64_t> take_ready() { return queue_.take_ready(); }
  /// Throws ConfigError if reopen() would be refused, while there still are endpoints to go on with: when a
  /// file of the profile or of security is missing or invalid, or DDS does not trust it. Where there is
  /// security, endpoints are made on trial.
  void check_reopening();
  /// Makes all DDS endpoints anew; the map and the queued messages stay. If it throws std::runtime_error
  /// because DDS refuses, nothing else may be called.
  void reopen();

  /// Whether DDS has taken nothing of what it received for some seconds: nobody can be matched any more.
  bool is_deaf() const;

  /// State and numbers in one line, for people.
  std::string summary() const { return core_.summary(); }

 private:
  /// Goes on with the map of a former service, if that left a snapshot.
  void resume();
  /// The arrivals through DDS, with the counters of this class added.
  core::Arrivals take_arrivals();
  void ask_itself(std::int64_t tick_ns);
  void publish(const PublishedMap& map, const RoadMarkings& markings);
  void publish(const ServiceStatus& status);
  void log_tick(const core::Tick& tick, const core::Messages& messages) const;
  template <class T>
  void write(dds::Writer<T>& writer, const T& message);

  Config config_;
  std::function<std::int64_t()> now_ns_;
  core::ServiceCore core_;
  IngestionQueue queue_;
  TimeWindow work_;
  TimeWindow delay_;
  Counters counters_;  ///< of events in this class
  IncidentLog incidents_;
  dds::SelfCheck itself_;  ///< of the newest question
  std::int64_t next_question_ns_ = 0;
  std::unique_ptr<snapshot::SnapshotWriter> snapshots_;  ///< null: no snapshots are kept
  std::unique_ptr<Endpoints> endpoints_;  ///< last, so that no callback meets a destroyed member
};

}  // namespace laneloom::service
