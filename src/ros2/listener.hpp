#pragma once

#include <memory>
#include <string>

#include "laneloom/config.hpp"
#include "laneloom/dds/reader.hpp"
#include "laneloom/next_turn.hpp"
#include "laneloom/objects.hpp"
#include "laneloom/types.hpp"

namespace laneloom::ros2 {

/// Callbacks for what nodes of ROS 2 write, as those of dds::Reader. A message without a session gets one
/// that is derived from its DDS writer, and the sequence number that DDS gave it.
struct Inputs {
  dds::ReaderCallbacks<DetectionFrame> detections;
  dds::ReaderCallbacks<VehiclePose> poses;
  dds::ReaderCallbacks<TrackedObjects> objects;
  dds::ReaderCallbacks<NextTurn> next_turns;
};

/// Reads what nodes of ROS 2 write for the service, on a participant of its own, and is no service. Not
/// thread-safe.
class Listener {
 public:
  /// `name` is shown to others. Throws as dds::Participant().
  Listener(const Config& config, const std::string& name, Inputs inputs);
  ~Listener();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace laneloom::ros2
