#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "laneloom/counters.hpp"
#include "laneloom/messages.hpp"
#include "laneloom/next_turn.hpp"
#include "laneloom/objects.hpp"
#include "laneloom/types.hpp"

namespace laneloom::core {

/// A message and the time of its arrival, by the steady clock.
struct Arrival {
  std::variant<VehiclePose, DetectionFrame, TrackedObjects, NextTurn> message;
  std::int64_t arrival_ns = 0;
};

/// The input of a tick, taken at one instant. The counters fit the messages: detections_received = refused +
/// dropped + the frames of all Arrivals so far, and likewise for poses, objects and turns. Times are by the
/// steady clock; none: never.
struct Arrivals {
  std::vector<Arrival> messages;                ///< since the tick before, in the order of their arrival
  Counters counters;                            ///< of events outside the core, since the start
  std::optional<std::int64_t> newest_frame_ns;  ///< arrival of the newest frame, refused or not
  std::optional<std::int64_t> newest_pose_ns;   ///< arrival of the newest pose, refused or not
  /// Arrival of the newest status of another service of this vehicle.
  std::optional<std::int64_t> other_service_ns;
  std::vector<SourceStatus> sources;   ///< the sessions heard last, in the order of their beginning
  std::vector<std::int64_t> heard_ns;  ///< arrival of the newest frame of each of these, refused or not
};

}  // namespace laneloom::core
