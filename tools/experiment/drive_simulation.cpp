#include "experiment/drive_simulation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulation/perception.hpp"

namespace laneloom::experiment {
namespace {

constexpr double kPeriod_s = 0.1;
constexpr std::int64_t kPeriod_ns = 100'000'000;

}  // namespace

DriveSimulation::DriveSimulation(const DriveSpec& spec)
    : spec_(spec),
      perception_(std::make_unique<simulation::Perception>(*spec.road, spec.noise, spec.view, spec.seed)),
      odometry_(transform(spec.road->drive.pose_at(0.0)), spec.drift) {
  if (spec.traffic) traffic_.emplace(*spec.road, *spec.traffic, spec.seed);
}

DriveSimulation::~DriveSimulation() = default;
DriveSimulation::DriveSimulation(DriveSimulation&&) noexcept = default;
DriveSimulation& DriveSimulation::operator=(DriveSimulation&&) noexcept = default;

SimulatedFrame DriveSimulation::next() {
  stamp_ns_ += kPeriod_ns;
  SimulatedFrame frame;
  VehiclePose pose = spec_.road->drive.pose_at(static_cast<double>(stamp_ns_) * 1e-9);
  pose.stamp_ns = stamp_ns_;
  frame.T_map_body = transform(pose);
  frame.record.frame = perception_->observe(pose);
  frame.sources = perception_->sources();
  if (traffic_) frame.record.objects = traffic_->observe(pose);
  if (spec_.drift > 0.0) {
    const Eigen::Isometry3d& told = odometry_.move_to(frame.T_map_body);
    pose.position = told.translation();
    pose.orientation = Eigen::Quaterniond(told.linear());
  }
  frame.record.pose = pose;
  return frame;
}

std::vector<SimulatedFrame> simulate(const DriveSpec& spec) {
  const simulation::Drive& drive = spec.road->drive;
  const double once_s = drive.duration_s();
  const double longest_s = drive.closed() ? std::numeric_limits<double>::infinity() : once_s;
  const double duration_s = spec.duration_s > 0.0 ? std::min(spec.duration_s, longest_s) : once_s;
  DriveSimulation simulation(spec);
  std::vector<SimulatedFrame> frames(static_cast<std::size_t>(std::floor(duration_s / kPeriod_s)));
  for (SimulatedFrame& frame : frames) frame = simulation.next();
  return frames;
}

}  // namespace laneloom::experiment
