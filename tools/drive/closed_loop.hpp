#pragma once

#include <iosfwd>
#include <optional>

#include "drive/drive_score.hpp"
#include "drive/map_service.hpp"
#include "drive/navigator.hpp"
#include "drive/path_planner.hpp"
#include "simulation/network_delay.hpp"
#include "simulation/noise_profile.hpp"
#include "simulation/odometry.hpp"
#include "simulation/perception.hpp"
#include "simulation/traffic.hpp"

namespace laneloom::drive {

/// The noise of the sensors and the speed of a simulated drive.
struct ClosedLoopSpec {
  simulation::NoiseProfile noise;
  std::uint64_t seed = 1;
  double speed_mps = 10.0;  ///< greatest speed
  double drift = 0.0;       ///< of the odometry, as a share of the distance driven
  std::optional<simulation::TrafficProfile> traffic = {};  ///< none: there is no tracker
  bool by_published_way = false;  ///< the map's own way leads, and the service is told the next turn
  std::int64_t start_ns = 1;      ///< of the sensor clock
  std::uint64_t session_id = 1;   ///< of the first start; each restart has the next id
};

/// A vehicle that is steered by the map which a service makes of the vehicle's own detections. The true road
/// only gives detections, poses, the turns that a driver would ask for, and the score.
///
/// When the vehicle has left its lane, it is put back onto its route further on. When the road ends, it is
/// put onto the drive behind the place where a missed turn led away from it, or else at its beginning. Both
/// restart perception and odometry, and thereby the map. The vehicle stands until the first map with a lane
/// under it; after a few seconds without one it creeps on.
///
/// Deterministic as far as the service is. Not thread-safe.
class ClosedLoop {
 public:
  static constexpr double kPeriod_s = 0.01;

  /// `road` and `service` must outlive this. Throws std::runtime_error if the road's drive is on none of its
  /// lanes.
  ClosedLoop(const simulation::Road& road, ClosedLoopSpec spec, MapService& service);

  /// One period: sensing, planning (ten times a second), control, and motion. Throws std::runtime_error if
  /// the vehicle, wherever it is put, is off its lane or at the road's end before it has driven a metre.
  void step();
  /// The score so far. A guess that has not ended yet is included.
  DriveScore score() const;
  double driven_m() const { return score_.driven_m; }
  double time_s() const { return score_.time_s; }

  /// The true state of the vehicle.
  const Bicycle& vehicle() const { return vehicle_; }

 private:
  std::int64_t now_ns() const;
  double now_s() const { return static_cast<double>(steps_) * kPeriod_s; }
  void restart(const Navigator::Start& start);
  void sense();
  void plan();
  void judge();
  void count_support(Support support);
  void count_comfort();
  Guess::Cause cause_of_guess(const LocalMap& map) const;
  double wanted_speed() const;

  const simulation::Road& road_;
  ClosedLoopSpec spec_;
  MapService& service_;
  LaneTracker lanes_;
  Navigator navigator_;
  simulation::Perception perception_;
  simulation::NetworkDelay<DetectionFrame> network_;
  std::optional<simulation::Traffic> traffic_;
  std::int64_t steps_ = 0;
  // Since the last restart.
  Bicycle vehicle_;                                           ///< the true state
  Bicycle told_;                                              ///< the state by the odometry
  Eigen::Isometry3d T_told_ = Eigen::Isometry3d::Identity();  ///< likewise
  std::optional<simulation::Odometry> odometry_;
  std::int64_t begun_ns_ = 0;
  bool started_ = false;
  Plan plan_;
  // For the score.
  DriveScore score_;
  std::optional<Guess> guess_;
  Guess::Cause cause_ = Guess::Cause::no_lane;
  bool in_inferred_lane_ = false;
  bool over_border_ = false;
  double last_curvature_ = 0.0, last_lateral_mps2_ = 0.0, last_driven_m_ = 0.0;
  double restarted_at_m_ = 0.0;  ///< distance driven in all at the last restart
  int vain_restarts_ = 0;        ///< number of restarts in a row without a metre between them
};

}  // namespace laneloom::drive
