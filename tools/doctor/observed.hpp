#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/dds/discovery.hpp"
#include "laneloom/messages.hpp"

/// What `laneloom doctor` sees, as plain data for findings.hpp to judge.
namespace laneloom {

/// Messages of one input topic, or of one source of them, as a reader of the doctor's own got them.
struct InputObserved {
  struct Newest {
    std::int64_t stamp_ns = 0;    ///< sensor clock
    std::int64_t arrival_ns = 0;  ///< steady clock, which is one for all inputs
  };
  std::uint64_t messages = 0;                    ///< refused ones included
  std::map<std::string, std::uint64_t> refused;  ///< by reason
  double window_s = 0.0;                         ///< from the first message to the end of the observation
  std::optional<Newest> newest;                  ///< that has a header, refused or not
  std::uint64_t unnumbered = 0;                  ///< have the sequence number and session of the one before
  std::uint64_t without_view = 0;                ///< detections without a field of view
  std::set<dds::WriterId> mixed;                 ///< writers whose messages came between another's
};

/// What one service told of itself.
struct ServiceObserved {
  ServiceStatus first, last;
  /// Of `last`'s clock behind ours, transmission included; of all statuses, the nearest to zero.
  double clock_offset_s = 0.0;
  std::uint64_t statuses = 0;
  std::string profile_file = {};  ///< of its DDS; empty: none
  /// Bytes that it receives whole; none: its profile cannot be read here.
  std::optional<std::uint32_t> largest_datagram = 65500;
};

/// A file of Fast DDS in /dev/shm.
struct SharedMemoryFile {
  std::string name, owner;
  bool ours = false;   ///< of the user that the doctor runs as
  bool stale = false;  ///< no process has it mapped
};

struct Observed {
  DdsConfig dds;  ///< as it was asked for; the map frame is the service's own where it told
  std::uint32_t largest_datagram = 65500;      ///< bytes that these settings receive whole
  std::vector<std::string> discovery_servers;  ///< whom these settings ask for the others
  double duration_s = 0.0;
  std::vector<dds::Peer> participants;  ///< all but those of doctors
  std::vector<dds::Endpoint> endpoints;
  InputObserved detections, poses;
  std::map<std::string, InputObserved> sources;  ///< detections that are well formed, by their source
  std::vector<ServiceObserved> services;         ///< of this vehicle, by session
  std::vector<int> listening_domains;            ///< that processes of this host are in
  std::vector<SharedMemoryFile> shared_memory;
};

}  // namespace laneloom
