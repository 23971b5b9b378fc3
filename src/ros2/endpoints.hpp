#pragma once

#include <cstddef>
#include <memory>

#include "laneloom/config.hpp"
#include "laneloom/dds/participant.hpp"
#include "laneloom/dds/reader.hpp"
#include "laneloom/messages.hpp"

namespace laneloom::ros2 {

/// All that nodes of ROS 2 see of the service, on a participant of its own: it is in no partition, and its
/// topics and types have the names that ROS gives them. Not thread-safe.
class Endpoints {
 public:
  /// What takes the inputs, as that of dds::Reader. A detection frame or a pose whose writer names no session
  /// has that of the DDS writer, and the number that DDS gave it.
  struct Inputs {
    dds::ReaderCallbacks<DetectionFrame> detections;
    dds::ReaderCallbacks<VehiclePose> poses;
  };
  /// Throws as dds::Participant().
  Endpoints(const Config& config, Inputs inputs, dds::Participant::Presence presence);
  ~Endpoints();

  /// Writes the lane map and its markers, and of a map to drive on the road segments, which cannot tell the
  /// state. Returns how many of them DDS did not take.
  std::size_t write(const PublishedMap& map);
  /// Writes the diagnostics. Returns likewise.
  std::size_t write(const ServiceStatus& status);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace laneloom::ros2
