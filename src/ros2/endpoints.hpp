#pragma once

#include <cstddef>
#include <memory>

#include "laneloom/config.hpp"
#include "laneloom/counters.hpp"
#include "laneloom/dds/participant.hpp"
#include "laneloom/messages.hpp"
#include "ros2/listener.hpp"

namespace laneloom::ros2 {

/// The endpoints of the service for nodes of ROS 2, on a participant of its own. It is in no partition, and
/// its topics and types have the names that ROS gives them. Not thread-safe.
class Endpoints {
 public:
  /// Throws as dds::Participant().
  Endpoints(const Config& config, Inputs inputs, dds::Participant::Presence presence);
  ~Endpoints();

  /// Writes the lane map, its markers and its road segments. Road segments have no room for the state, so
  /// that they are only written for a map to drive on. Returns how many messages DDS did not take.
  std::size_t write(const PublishedMap& map);
  /// Writes the diagnostics. Returns how many messages DDS did not take.
  std::size_t write(const ServiceStatus& status);
  /// Whether another participant writes the topic of the lane map, such as the service of a second vehicle in
  /// the same namespace.
  bool has_another_writer() const;
  /// As dds::Participant::refused_datagrams().
  Counters refused_datagrams() const;
  /// As dds::Participant::ask_itself().
  dds::SelfCheck ask_itself();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace laneloom::ros2
