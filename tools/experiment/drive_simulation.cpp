#include "experiment/drive_simulation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulation/perception.hpp"

namespace laneloom {
namespace {

constexpr double kPeriod_s = 0.1;
constexpr std::int64_t kPeriod_ns = 100'000'000;

/// Adds up the true motion, with an error in every step.
class Odometry {
 public:
  Odometry(const Eigen::Isometry3d& start, double drift) : true_(start), told_(start), drift_(drift) {}

  const Eigen::Isometry3d& move_to(const Eigen::Isometry3d& T_map_body) {
    constexpr double kYawPerMetre = 0.01;  // of the drift: after s metres, 0.005 s^2 of it are sideways
    Eigen::Isometry3d step = true_.inverse() * T_map_body;
    const double length_m = step.translation().norm();
    step.translation() *= 1.0 + drift_;
    step.rotate(Eigen::AngleAxisd(kYawPerMetre * drift_ * length_m, Point::UnitZ()));
    true_ = T_map_body;
    told_ = told_ * step;
    return told_;
  }

 private:
  Eigen::Isometry3d true_, told_;
  double drift_;
};

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
