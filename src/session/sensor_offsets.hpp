#pragma once

#include <map>
#include <string>

#include "laneloom/network_profile.hpp"
#include "laneloom/types.hpp"

namespace laneloom::session {

/// The name of a value of a network's profile: metres by which the frame of the network's points lies to the
/// left in the body frame.
inline constexpr const char* kSensorLeft = "sensor_left_m";

/// Constant lateral offsets of the sources of detections, as their profiles tell them.
class SensorOffsets {
 public:
  /// Takes the offsets out of the profiles, whose other values are the mapper's. Throws ConfigError naming
  /// the source if an offset is beyond 10 m.
  explicit SensorOffsets(NetworkProfiles& profiles);

  /// Takes all points of a frame to the body frame.
  void apply(DetectionFrame& frame) const;

 private:
  std::map<std::string, double> left_m_;  ///< by source
};

}  // namespace laneloom::session
