#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/arrivals.hpp"
#include "core/health.hpp"
#include "core/tick.hpp"
#include "laneloom/config.hpp"
#include "laneloom/messages.hpp"
#include "session/mapping_session.hpp"
#include "snapshot/snapshot_file.hpp"

namespace laneloom::core {

/// The version of laneloom.
const char* version();

/// The functions by which the core knows the world beside its messages.
struct Surroundings {
  std::function<std::int64_t()> steady_now_ns;  ///< the steady clock
  std::function<std::int64_t()> system_now_ns;  ///< the system clock
  std::function<std::uint64_t()> new_id;        ///< a different id at every call, never 0
};

/// The output of a tick.
struct Messages {
  PublishedMap map;
  RoadMarkings road_markings;
  std::optional<ServiceStatus> status;  ///< without its fields tick and tick_delay; none: it is not due
  std::optional<snapshot::Snapshot> snapshot;  ///< to be kept for a restart; none: it is not due
  bool state_changed = false;  ///< the state or its reasons differ from those of the tick before
};

/// The work of the service: takes the messages that came, updates the map, judges how far it can be relied
/// on, and returns the messages to publish. It has no DDS, no thread and no clock of its own, so that its
/// output depends on its arguments and surroundings alone. Not thread-safe.
class ServiceCore {
 public:
  /// Throws ConfigError when the file of the SD map is missing or invalid.
  ServiceCore(const Config& config, Surroundings surroundings);

  /// Fuses frames for at most half a tick's period, and one frame at least. Frames for which no time is left
  /// wait for the next tick; the map's state then names the reason overloaded.
  Messages tick(const Tick& tick, Arrivals&& arrivals);

  /// Goes on with the map of a former service. Is to be called before the first tick.
  void resume(snapshot::Snapshot&& snapshot);
  /// The stamp of a snapshot made now. A snapshot with another maker is of no use to this service.
  snapshot::SnapshotStamp snapshot_stamp() const;

  /// Names this run of the service.
  std::uint64_t session_id() const { return session_id_; }
  const session::MappingSession& session() const { return session_; }
  /// Lets `observer` be told of the stages of every fused frame.
  void observe(StageObserver* observer) { session_.observe(observer); }
  /// State and numbers in one line, for people.
  std::string summary() const;

 private:
  void fuse(const Tick& tick, std::vector<Arrival>&& messages);
  /// The facts for Health at `now_ns`.
  HealthInputs inputs(std::int64_t now_ns, const Arrivals& arrivals) const;
  /// Whether one of several sources that was heard a moment ago does not go into the map.
  bool source_not_fused(std::int64_t now_ns, const Arrivals& arrivals) const;
  void note_incidents(const Tick& tick, const Arrivals& arrivals,
                      const session::MappingSession::Progress& progress);
  PublishedMap published_map(session::MappingSession::Progress&& progress);
  ServiceStatus status(const Arrivals& arrivals, const HealthInputs& inputs);
  void add_progress(SourceStatus& source) const;
  std::optional<snapshot::Snapshot> snapshot_if_due(std::int64_t now_ns);

  Config config_;
  Surroundings surroundings_;
  std::string config_hash_;
  std::string maker_;  ///< names this service in snapshots, see SnapshotStamp
  std::uint64_t session_id_;
  std::uint64_t map_id_;  ///< ids of elements are valid while it stays
  std::int64_t started_ns_;
  session::MappingSession session_;
  Health health_;
  Verdict verdict_;
  Counters counters_;  ///< of events in the core
  std::uint64_t unsynchronised_seen_ = 0;
  std::uint64_t overload_seen_ = 0;
  std::uint64_t map_sequence_ = 0;
  std::uint64_t status_sequence_ = 0;
  std::int64_t next_status_ns_;
  std::int64_t next_snapshot_ns_;
};

}  // namespace laneloom::core
