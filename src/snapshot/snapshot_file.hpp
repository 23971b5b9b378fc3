#pragma once

#include <cstdint>
#include <string>

#include "laneloom/config.hpp"
#include "mapping/state.hpp"
#include "session/mapping_session.hpp"

namespace laneloom {

/// Who makes a snapshot, and when.
struct SnapshotStamp {
  std::string maker;           ///< version and configuration
  std::int64_t steady_ns = 0;  ///< begins anew with the host
  std::int64_t system_ns = 0;  ///< may be set
};

/// What a service that starts again goes on with.
struct Snapshot {  // NOLINT(bugprone-exception-escape): as the state
  SnapshotStamp stamp;
  std::uint64_t map_id = 0;  ///< the ids in the state belong to it
  MappingSession::Checkpoint checkpoint;
  MapperState state;
};

/// Takes the place of `file` as a whole; only this user reads it. Throws std::runtime_error.
void write_snapshot(const std::string& file, const Snapshot& snapshot);

/// The snapshot, if its file is one of this user's or root's, undamaged, of the same maker as `now`, and by
/// both clocks at most `max_age_s` older. Throws std::runtime_error that says why it is refused.
Snapshot read_snapshot(const std::string& file, const SnapshotStamp& now, double max_age_s,
                       const MapperConfig& config);

}  // namespace laneloom
