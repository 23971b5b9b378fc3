#pragma once

#include <filesystem>
#include <istream>
#include <vector>

#include "doctor/observed.hpp"

/// Facts that this host tells of participants on it. Facts that may not be read are left out.
namespace laneloom::doctor {

/// The domains whose discovery some process listens to, in ascending order. `sockets` has the form of
/// /proc/net/udp.
std::vector<int> listening_domains(std::istream& sockets);

/// Fast DDS's files in `folder` (/dev/shm), without those that are for locking alone. `processes` is /proc.
/// If the mappings of a user's processes may not be read, none of this user's files is called stale.
std::vector<SharedMemoryFile> shared_memory_files(const std::filesystem::path& folder,
                                                  const std::filesystem::path& processes);

/// The processes of laneloomd in a domain. `processes` is /proc. A process of another user is left out,
/// unless root asks.
std::vector<ServiceProcess> service_processes(const std::filesystem::path& processes, int domain);

}  // namespace laneloom::doctor
