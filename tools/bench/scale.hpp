#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "bench/mapper_cost.hpp"

/// How the mapper's cost grows.
namespace laneloom {

/// The frame's detections, `copies` times: each copy is displaced to the left by another share of the range's
/// width, and what would leave the range enters it on the other side.
DetectionFrame multiplied(const DetectionFrame& frame, std::size_t copies, double side_max_m);

/// Range and view, `factor` times as far to every side.
RangeConfig scaled(RangeConfig range, double factor);
SensorView scaled(SensorView view, double factor);

/// Of one minute of a drive.
struct MinuteCost {
  std::size_t minute = 0;  ///< from 1
  MapperCost cost;         ///< counted while it was timed
  double rss_mb = 0.0;     ///< of this process, at the minute's end
};

/// Calls `take` after every whole minute. Frames are simulated one by one, so that their number takes no
/// memory.
void drive_minutes(const MapperConfig& config, const DriveSpec& drive, std::size_t minutes,
                   const std::function<void(const MinuteCost&)>& take);

/// The road with a vehicle that stands where its drive is after `t_s`.
Road standing(Road road, double t_s);

/// Of all updates of as many vehicles, whose mappers take turns, so that each of them finds its data out of
/// the processor's nearest caches. Every vehicle sees the same frames.
TimeSummary time_vehicles(const MapperConfig& config, const std::vector<SimulatedFrame>& frames,
                          std::size_t vehicles);

}  // namespace laneloom
