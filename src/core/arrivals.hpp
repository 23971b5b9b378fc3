#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "laneloom/counters.hpp"
#include "laneloom/messages.hpp"
#include "laneloom/types.hpp"

namespace laneloom {

/// A message and when it came, by the steady clock.
struct Arrival {
  std::variant<VehiclePose, DetectionFrame> message;
  std::int64_t arrival_ns = 0;
};

/// What a tick works on, taken at one instant: detections_received = refused + dropped + the frames of all
/// Arrivals so far, and likewise of poses. Times are by the steady clock; none: never.
struct Arrivals {
  std::vector<Arrival> messages;                ///< since the tick before, in the order of their arrival
  Counters counters;                            ///< of what happened outside the core, since the start
  std::optional<std::int64_t> newest_frame_ns;  ///< arrival
  std::optional<std::int64_t> newest_pose_ns;
  std::optional<std::int64_t> other_service_ns;  ///< a status of another service of this vehicle
  std::vector<SourceStatus> sources;             ///< the newest sessions, in the order of their beginning
};

}  // namespace laneloom
