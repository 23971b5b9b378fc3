#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/messages.hpp"

namespace laneloom::core {

/// The facts that the health of a map is judged by. Ages are seconds since an arrival, by the steady clock;
/// -1: nothing came yet.
struct HealthInputs {
  double detections_age_s = -1.0;     ///< since the arrival of the newest detections
  double poses_age_s = -1.0;          ///< since the arrival of the newest pose
  double fused_age_s = -1.0;          ///< since the arrival of the newest frame in the map
  double other_service_age_s = -1.0;  ///< since a status of another service of this vehicle
  std::optional<double> lag_s;  ///< from the newest fused stamp to the newest pose's; none: nothing was fused
  bool source_not_fused = false;  ///< one of several sources was heard a moment ago, but is not fused
  bool sources_disagree = false;  ///< a source is left out because it contradicts another one
  bool driving_side_contradicted = false;  ///< traffic keeps to the other side than is configured
};

/// How far the map can be relied on, and why.
struct Verdict {
  MapState state = MapState::stale;
  std::vector<StateReason> reasons;  ///< empty where the state is OK
  bool operator==(const Verdict&) const = default;
};

/// Judges how far the map can be relied on. STALE: nothing was fused for stale_after_s. DEGRADED: input is
/// missing, or something went wrong within the last second. Times are by the steady clock; the lag is by the
/// stamps of the sensors.
class Health {
 public:
  explicit Health(ServiceConfig config) : config_(std::move(config)) {}

  void note_reset(std::int64_t now_ns) { reset_ns_ = now_ns; }
  void note_unsynchronised(std::int64_t now_ns) { unsynchronised_ns_ = now_ns; }
  void note_overload(std::int64_t now_ns) { overload_ns_ = now_ns; }
  void note_pose_jump(std::int64_t now_ns) { pose_jump_ns_ = now_ns; }

  Verdict assess(std::int64_t now_ns, const HealthInputs& inputs) const;

 private:
  ServiceConfig config_;
  std::optional<std::int64_t> reset_ns_;
  std::optional<std::int64_t> unsynchronised_ns_;
  std::optional<std::int64_t> overload_ns_;
  std::optional<std::int64_t> pose_jump_ns_;
};

/// Seconds since an arrival; -1: never.
double age_s(std::int64_t now_ns, const std::optional<std::int64_t>& arrival_ns);

}  // namespace laneloom::core
