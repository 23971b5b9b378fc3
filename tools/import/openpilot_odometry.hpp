#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "base/left_out.hpp"
#include "laneloom/types.hpp"

namespace laneloom::imports {

/// Takes forward, right, down to forward, left, up, and back.
inline const Eigen::DiagonalMatrix<double, 3> kTurned(1.0, -1.0, -1.0);

/// Sums up the odometry of a log of openpilot. Not thread-safe.
class OpenpilotOdometry {
 public:
  /// Takes a livePose or liveLocationKalman. Returns whether openpilot believes it. Throws JsonError.
  bool add_pose(const nlohmann::json& pose, std::int64_t stamp_ns);
  /// Takes a liveCalibration, if it is calibrated. Throws JsonError.
  void add_calibration(const nlohmann::json& calibration, std::int64_t stamp_ns);

  /// The poses of the calibrated frame, by stamp. Those that the service would refuse are left out. Throws
  /// std::runtime_error of the first one if `left_out` is strict.
  std::vector<VehiclePose> poses(LeftOut& left_out) const;

 private:
  struct Motion {
    Eigen::Matrix3d T_ned_device;
    Eigen::Vector3d velocity_ned;  ///< m/s
  };

  Eigen::Matrix3d T_device_calibrated(std::int64_t stamp_ns) const;

  std::map<std::int64_t, Motion> motions_;                ///< by stamp, as logs are not in its order
  std::map<std::int64_t, Eigen::Matrix3d> calibrations_;  ///< T_device_calibrated, likewise
};

}  // namespace laneloom::imports
