#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "bench/mapper_cost.hpp"

/// Measures how the mapper's cost grows with its input.
namespace laneloom::bench {

/// The frame with its detections `copies` times. Each copy is displaced to the left by another share of the
/// range's width. A line that would leave the range enters it on the other side.
DetectionFrame multiplied(const DetectionFrame& frame, std::size_t copies, double side_max_m);

/// The range or view, `factor` times as far to every side.
RangeConfig scaled(RangeConfig range, double factor);
simulation::SensorView scaled(simulation::SensorView view, double factor);

/// The cost of one minute of a drive.
struct MinuteCost {
  std::size_t minute = 0;  ///< from 1
  MapperCost cost;
  double rss_mb = 0.0;  ///< of this process, at the minute's end
};

/// Calls `take` after every whole minute. Frames are simulated one by one, so that their number takes no
/// memory.
void drive_minutes(const MapperConfig& config, const experiment::DriveSpec& drive, std::size_t minutes,
                   const std::function<void(const MinuteCost&)>& take);

/// The road with a vehicle that stands at the place that its drive reaches after `t_s`.
simulation::Road standing(simulation::Road road, double t_s);

/// The times of all updates of several vehicles, which see the same frames. Their mappers take turns, so that
/// the data of each is no longer in the processor's nearest caches.
TimeSummary time_vehicles(const MapperConfig& config, const std::vector<experiment::SimulatedFrame>& frames,
                          std::size_t vehicles);

}  // namespace laneloom::bench
