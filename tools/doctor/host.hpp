#pragma once

#include <filesystem>
#include <istream>
#include <vector>

#include "doctor/observed.hpp"

/// What this host tells of participants on it. All is left out that may not be read.
namespace laneloom {

/// The domains whose discovery some process listens to, in ascending order; `sockets` as in /proc/net/udp.
std::vector<int> listening_domains(std::istream& sockets);

/// Fast DDS's files in `folder` (/dev/shm), but those that are for locking alone. Of other users with
/// processes whose mappings may not be read (in `processes`, /proc), none is said to be stale.
std::vector<SharedMemoryFile> shared_memory_files(const std::filesystem::path& folder,
                                                  const std::filesystem::path& processes);

}  // namespace laneloom
