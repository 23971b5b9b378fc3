#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "check/drive.hpp"
#include "laneloom/config.hpp"
#include "laneloom/dds/discovery.hpp"
#include "laneloom/messages.hpp"

/// The observations of `laneloom doctor`, as plain data for findings.hpp to judge.
namespace laneloom::doctor {

/// The messages of one input topic, or of one source of detections, that a reader of the doctor got.
struct InputObserved {
  struct Newest {
    std::int64_t stamp_ns = 0;    ///< sensor clock
    std::int64_t arrival_ns = 0;  ///< steady clock, which is one for all inputs
  };
  std::uint64_t messages = 0;                    ///< refused ones included
  std::map<std::string, std::uint64_t> refused;  ///< by reason
  double window_s = 0.0;                         ///< from the first message to the end of the observation
  std::optional<Newest> newest;                  ///< newest message with a header, refused or not
  std::uint64_t unnumbered = 0;                  ///< number with the sequence and session of the one before
  std::uint64_t without_view = 0;                ///< number of detection frames without a field of view
  double best_confidence = -1.0;                 ///< of all detections; -1: there was none
  std::set<dds::WriterId> mixed;                 ///< writers whose messages came between those of another
};

/// The reports of one service on itself.
struct ServiceObserved {
  ServiceStatus first, last;
  /// The offset of the service's clock behind ours, transmission included. Of all statuses, it is the value
  /// nearest to zero.
  double clock_offset_s = 0.0;
  std::uint64_t statuses = 0;
  std::string profile_file = {};  ///< profile of its DDS; empty: none
  /// Longest datagram that it receives whole, in bytes. None: its profile cannot be read here.
  std::optional<std::uint32_t> largest_datagram = 65500;
};

/// A file of Fast DDS in /dev/shm.
struct SharedMemoryFile {
  std::string name, owner;
  bool ours = false;   ///< belongs to the user that the doctor runs as
  bool stale = false;  ///< no process has it mapped
};

/// A process of this host that runs the service in the doctor's domain, as its sockets tell.
struct ServiceProcess {
  int id = 0;
  bool stopped = false;  ///< by a signal (SIGSTOP) or a debugger
};

/// All that a doctor saw in a domain and on its host.
struct Observed {
  DdsConfig dds;  ///< as the user gave it; the map frame is the service's, if it is known
  std::uint32_t largest_datagram = 65500;  ///< longest datagram that these settings receive whole, in bytes
  std::vector<std::string> discovery_servers;  ///< servers that these settings ask for other participants
  double duration_s = 0.0;
  std::vector<dds::Peer> participants;  ///< without those of doctors
  std::vector<dds::Endpoint> endpoints;
  InputObserved detections, poses, objects, next_turns;
  std::map<std::string, InputObserved> sources;  ///< detections that are well formed, by their source
  std::vector<ServiceObserved> services;         ///< of this vehicle, by session
  std::vector<int> listening_domains;            ///< domains that processes of this host are in
  std::vector<SharedMemoryFile> shared_memory;
  std::vector<ServiceProcess> service_processes;  ///< of any vehicle
  check::Drive drive;                             ///< detections and poses that are well formed
};

}  // namespace laneloom::doctor
