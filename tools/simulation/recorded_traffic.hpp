#pragma once

#include <cstdint>
#include <vector>

#include "laneloom/objects.hpp"
#include "laneloom/types.hpp"
#include "simulation/drive.hpp"

namespace laneloom::simulation {

/// Other vehicles of a recorded drive, as a tracker tells of them that errs in nothing. Not thread-safe.
class RecordedTraffic {
 public:
  /// `objects` were seen from `drive`, in the body frame, and in the order of their stamps. `start_ns` is
  /// their clock at the drive's start.
  RecordedTraffic(std::vector<TrackedObjects> objects, const Drive& drive, std::int64_t start_ns);

  /// The objects seen from `pose`, at its stamp, so many seconds after the drive's start: those that were
  /// seen up to 0.15 s before, moved on by their speeds.
  TrackedObjects observe(const VehiclePose& pose, double drive_s);

 private:
  std::vector<TrackedObjects> seen_;  ///< in the map frame, by times since the drive's start
  std::uint64_t sequence_ = 0;
};

}  // namespace laneloom::simulation
