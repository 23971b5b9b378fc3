#include "import/openpilot_odometry.hpp"

#include <iterator>
#include <stdexcept>
#include <string>

#include "io/json_fields.hpp"
#include "session/gate.hpp"

namespace laneloom::imports {
namespace {

using nlohmann::json;

/// Reads a vector: [x, y, z], or an object of x, y and z.
Eigen::Vector3d vector(const json& value) {
  if (value.is_array()) return io::point(value);
  return {io::required(value, "x", io::number), io::required(value, "y", io::number),
          io::required(value, "z", io::number)};
}

Eigen::Matrix3d rotation(const Eigen::Vector3d& roll_pitch_yaw) {
  using Eigen::AngleAxisd;
  return (AngleAxisd(roll_pitch_yaw.z(), Point::UnitZ()) * AngleAxisd(roll_pitch_yaw.y(), Point::UnitY()) *
          AngleAxisd(roll_pitch_yaw.x(), Point::UnitX()))
      .toRotationMatrix();
}

/// A value, and whether openpilot believes it. It is an object of x, y and z in livePose, and a list in
/// liveLocationKalman.
struct Measurement {
  Eigen::Vector3d value;
  bool valid = false;
};

Measurement measurement(const json& object) {
  const bool valid = io::required(object, "valid", io::boolean);
  if (!valid) return {};
  return {object.contains("value") ? io::required(object, "value", vector) : vector(object), true};
}

/// One velocity that no car has would move all later poses, because positions are sums.
Measurement velocity(const json& object) {
  const Measurement velocity = measurement(object);
  if (velocity.valid && !(velocity.value.norm() <= GateConfig{}.max_speed_mps))
    throw io::JsonError("is too fast");
  return velocity;
}

}  // namespace

bool OpenpilotOdometry::add_pose(const json& pose, std::int64_t stamp_ns) {
  const Measurement orientation = io::required(pose, "orientationNED", measurement);
  const Measurement speed = io::required(pose, "velocityDevice", velocity);
  if (!orientation.valid || !speed.valid) return false;
  const Eigen::Matrix3d T_ned_device = rotation(orientation.value);
  if (!motions_.try_emplace(stamp_ns, Motion{T_ned_device, T_ned_device * speed.value}).second)
    throw io::JsonError("a second pose of this stamp");
  return true;
}

void OpenpilotOdometry::add_calibration(const json& calibration, std::int64_t stamp_ns) {
  if (io::required(calibration, "calStatus", io::text) != "calibrated") return;
  calibrations_[stamp_ns] = rotation(io::required(calibration, "rpyCalib", io::point));
}

/// The newest calibration at a stamp. Before the first calibration, it is the first one.
Eigen::Matrix3d OpenpilotOdometry::T_device_calibrated(std::int64_t stamp_ns) const {
  if (calibrations_.empty()) return Eigen::Matrix3d::Identity();
  const auto after = calibrations_.upper_bound(stamp_ns);
  return after == calibrations_.begin() ? after->second : std::prev(after)->second;
}

std::vector<VehiclePose> OpenpilotOdometry::poses(LeftOut& left_out) const {
  std::vector<VehiclePose> poses;
  Point position_ned = Point::Zero();
  for (auto now = motions_.begin(); now != motions_.end(); ++now) {
    if (now != motions_.begin()) {
      const auto before = std::prev(now);
      const double step_s = 1e-9 * static_cast<double>(now->first - before->first);
      position_ned += 0.5 * step_s * (before->second.velocity_ned + now->second.velocity_ned);
    }
    const Eigen::Matrix3d turned(kTurned);
    const Eigen::Matrix3d T_ned_calibrated = now->second.T_ned_device * T_device_calibrated(now->first);
    VehiclePose pose{.stamp_ns = now->first, .position = kTurned * position_ned};
    pose.orientation = Eigen::Quaterniond(Eigen::Matrix3d(turned * T_ned_calibrated * turned)).normalized();
    if (const auto why = session::defect(pose, GateConfig{}); why.empty()) {
      poses.push_back(pose);
    } else {
      const std::string reason = "the service would refuse a pose: " + std::string(why);
      if (left_out.strict()) throw std::runtime_error(reason);
      left_out.add(reason, "logMonoTime " + std::to_string(pose.stamp_ns));
    }
  }
  return poses;
}

}  // namespace laneloom::imports
