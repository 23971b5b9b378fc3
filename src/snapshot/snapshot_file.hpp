#pragma once

#include <cstdint>
#include <string>

#include "laneloom/config.hpp"
#include "mapping/state.hpp"
#include "session/mapping_session.hpp"

namespace laneloom::snapshot {

/// The maker and the time of a snapshot.
struct SnapshotStamp {
  std::string maker;           ///< version, and hashes of the configuration and of the files that it names
  std::int64_t steady_ns = 0;  ///< steady clock, which begins anew when the host starts
  std::int64_t system_ns = 0;  ///< system clock, which may be set
};

/// The data with which a restarted service goes on.
struct Snapshot {  // NOLINT(bugprone-exception-escape): as the state
  SnapshotStamp stamp;
  std::uint64_t map_id = 0;                        ///< the ids in the state belong to it
  session::MappingSession::Checkpoint checkpoint;  ///< the newest inputs of the map
  MapperState state;
};

/// Writes a snapshot in the place of `file` as a whole. Only this user can read it. Throws
/// std::runtime_error.
void write_snapshot(const std::string& file, const Snapshot& snapshot);

/// Throws ConfigError if no snapshot can be kept in `file`: its folder is missing or cannot be written, or a
/// file that is no snapshot has its name, or one that it gets when it is taken.
void check_snapshot_file(const std::string& file);

/// Takes a snapshot out of the way to go on with it, and returns the file that it is in now. The same one can
/// be taken again where a service ends before it has made a newer one, three times in all: a map that ends
/// the service shall not do so for ever. Empty: there is none. Throws ConfigError, and moves nothing, if a
/// file that is no snapshot has one of these names.
std::string take_snapshot(const std::string& file);

/// Reads a snapshot. Throws std::runtime_error with the reason unless its file belongs to this user or to
/// root and is undamaged, its maker is that of `now`, and it is by both clocks at most `max_age_s` older.
Snapshot read_snapshot(const std::string& file, const SnapshotStamp& now, double max_age_s,
                       const MapperConfig& config);

}  // namespace laneloom::snapshot
