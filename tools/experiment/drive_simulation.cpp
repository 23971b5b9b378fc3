#include "experiment/drive_simulation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulation/odometry.hpp"
#include "simulation/perception.hpp"

namespace laneloom {
namespace {

constexpr double kPeriod_s = 0.1;
constexpr std::int64_t kPeriod_ns = 100'000'000;

}  // namespace

std::vector<SimulatedFrame> simulate(const DriveSpec& spec) {
  const Drive& drive = spec.road->drive;
  const double once_s = drive.duration_s();
  const double longest_s = drive.closed() ? std::numeric_limits<double>::infinity() : once_s;
  const double duration_s = spec.duration_s > 0.0 ? std::min(spec.duration_s, longest_s) : once_s;
  Perception perception(*spec.road, spec.noise, SensorView{}, spec.seed);
  Odometry odometry(transform(drive.pose_at(0.0)), spec.drift);
  std::vector<SimulatedFrame> frames(static_cast<std::size_t>(std::floor(duration_s / kPeriod_s)));
  std::int64_t stamp_ns = 0;
  for (SimulatedFrame& frame : frames) {
    stamp_ns += kPeriod_ns;
    VehiclePose pose = drive.pose_at(static_cast<double>(stamp_ns) * 1e-9);
    pose.stamp_ns = stamp_ns;
    frame.T_map_body = transform(pose);
    frame.record.frame = perception.observe(pose);
    frame.sources = perception.sources();
    if (spec.drift > 0.0) {
      const Eigen::Isometry3d& told = odometry.move_to(frame.T_map_body);
      pose.position = told.translation();
      pose.orientation = Eigen::Quaterniond(told.linear());
    }
    frame.record.pose = pose;
  }
  return frames;
}

}  // namespace laneloom
