#include "bench/scale.hpp"

#include <unistd.h>

#include <cmath>
#include <utility>

#include "bench/process_usage.hpp"

namespace laneloom::bench {
namespace {

constexpr std::size_t kFramesPerMinute = 600;

double mean_y(const Polyline& points) {
  double sum = 0.0;
  for (const Point& point : points) sum += point.y();
  return points.empty() ? 0.0 : sum / static_cast<double>(points.size());
}

/// A detection, displaced sideways by `offset_m`. Its mean is wrapped into ±side_m.
Detection displaced(Detection detection, double offset_m, double side_m) {
  const double y_m = mean_y(detection.points);
  const double width_m = 2.0 * side_m;
  const double target_m = y_m + offset_m + side_m;
  const double shift_m = target_m - width_m * std::floor(target_m / width_m) - side_m - y_m;
  for (Point& point : detection.points) point.y() += shift_m;
  return detection;
}

}  // namespace

DetectionFrame multiplied(const DetectionFrame& frame, std::size_t copies, double side_max_m) {
  DetectionFrame result = frame;
  result.detections.reserve(copies * frame.detections.size());
  for (std::size_t copy = 1; copy < copies; ++copy) {
    const double offset_m = 2.0 * side_max_m * static_cast<double>(copy) / static_cast<double>(copies);
    for (const Detection& detection : frame.detections)
      result.detections.push_back(displaced(detection, offset_m, side_max_m));
  }
  return result;
}

RangeConfig scaled(RangeConfig range, double factor) {
  range.forward_min_m *= factor;
  range.forward_max_m *= factor;
  range.side_max_m *= factor;
  return range;
}

simulation::SensorView scaled(simulation::SensorView view, double factor) {
  view.forward_min_m *= factor;
  view.forward_max_m *= factor;
  view.side_max_m *= factor;
  return view;
}

void drive_minutes(const MapperConfig& config, const experiment::DriveSpec& drive, std::size_t minutes,
                   const std::function<void(const MinuteCost&)>& take) {
  experiment::DriveSimulation simulation(drive);
  MapperMeter meter(config, true);
  for (std::size_t minute = 1; minute <= minutes; ++minute) {
    for (std::size_t i = 0; i < kFramesPerMinute; ++i) meter.update(simulation.next().record);
    take({minute, meter.take_cost(), rss_mb(getpid())});
  }
}

simulation::Road standing(simulation::Road road, double t_s) {
  VehiclePose pose = road.drive.pose_at(t_s);
  road.drive = simulation::Drive::recorded({pose});
  return road;
}

TimeSummary time_vehicles(const MapperConfig& config, const std::vector<experiment::SimulatedFrame>& frames,
                          std::size_t vehicles) {
  std::vector<MapperMeter> meters;
  meters.reserve(vehicles);
  for (std::size_t i = 0; i < vehicles; ++i) meters.emplace_back(config, false);
  for (const experiment::SimulatedFrame& frame : frames) {
    for (MapperMeter& meter : meters) meter.update(frame.record);
  }
  std::vector<double> all_ms;
  all_ms.reserve(vehicles * frames.size());
  for (MapperMeter& meter : meters) {
    const MapperCost cost = meter.take_cost();
    all_ms.insert(all_ms.end(), cost.update_ms.begin(), cost.update_ms.end());
  }
  return support::summarise(std::move(all_ms));
}

}  // namespace laneloom::bench
