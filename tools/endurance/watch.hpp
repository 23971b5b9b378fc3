#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/dds/reader.hpp"
#include "laneloom/messages.hpp"

namespace laneloom::endurance {

/// A planner that notes the messages of all services of a vehicle, which run one after another. Thread-safe.
class Watch {
 public:
  explicit Watch(const DdsConfig& dds);

  /// Waits for a map that is published after this call, is OK and has lanes. False: none came within
  /// `patience`.
  bool wait_for_good_map(std::chrono::seconds patience) const;
  /// Waits for a status that is written after this call and has no pending frames. False: none came within
  /// `patience`.
  bool wait_for_settled_status(std::chrono::seconds patience) const;

  struct Session {
    ServiceStatus last;
    std::vector<SourceStatus> sources;  ///< of all its statuses, each in its last state
  };
  std::map<std::uint64_t, Session> sessions() const;

  struct Maps {
    std::uint64_t received = 0;
    std::uint64_t missed = 0;
    std::vector<std::string> violations;  ///< of the contract
  };
  Maps maps() const;

 private:
  void take(PublishedMap&& map);
  void take(ServiceStatus&& status);

  mutable std::mutex mutex_;
  std::map<std::uint64_t, Session> sessions_;
  std::uint64_t settled_statuses_ = 0;
  Maps maps_;
  std::uint64_t good_maps_ = 0;
  std::optional<PublishedMap> previous_;
  dds::Participant participant_;
  dds::Reader<PublishedMap> map_reader_;
  dds::Reader<ServiceStatus> status_reader_;
};

}  // namespace laneloom::endurance
