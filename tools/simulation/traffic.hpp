#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "laneloom/objects.hpp"
#include "laneloom/polyline.hpp"
#include "simulation/random.hpp"
#include "simulation/road.hpp"

namespace laneloom::simulation {

/// Other vehicles, and how a tracker errs that follows them. Standard deviations are of one axis.
struct TrafficProfile {
  double vehicles_per_km = 20.0;  ///< on each lane
  double parked_per_km = 10.0;    ///< beside each lane
  double wrong_way_share =
      0.0;                  ///< drive at the border of a lane against it, as cyclists that are told as cars
  double speed_mps = 10.0;  ///< mean
  double offset_stddev_m = 0.4;      ///< of a driver, from the middle of the lane
  double lane_changes_per_s = 0.02;  ///< of each vehicle, where there is a lane to change into
  double overtakings_per_s = 0.0;    ///< of each vehicle, into an oncoming lane and back
  double position_stddev_m = 0.3;    ///< of the tracker, at the vehicle; half the variance lasts per object
  double position_stddev_per_m = 0.02;
  double heading_stddev_rad = 0.05;
  double flipped_share = 0.01;  ///< of objects whose heading is the wrong way round
  double id_period_s = 30.0;    ///< mean time until an object gets another id
  double missed_share = 0.05;   ///< of objects, each frame anew
  double ghosts = 0.2;          ///< mean number at a time, of a second's duration
};

/// The profile of a name: "exact" errs in nothing, "usual" as an on-board tracker does, "hostile" as a bad
/// one among bad drivers. Throws std::invalid_argument for another name.
TrafficProfile traffic_profile(const std::string& name);
std::vector<std::string> traffic_profile_names();

/// Other vehicles on a road, as a tracker tells of them. The same road, profile, seed and poses give the same
/// objects. Vehicles drive along lanes and through intersections; they do not give way to one another, nor to
/// the vehicle. Not thread-safe.
class Traffic {
 public:
  Traffic(const Road& road, TrafficProfile profile, std::uint64_t seed);

  /// The objects seen from `pose`, at its stamp. Poses come in the order of stamps.
  TrackedObjects observe(const VehiclePose& pose);

 private:
  enum class Kind : std::uint8_t { driving, parked, wrong_way };
  /// A manoeuvre to the side.
  struct Manoeuvre {
    double target_m = 0.0;            ///< to the left of the lane
    std::optional<std::size_t> lane;  ///< the lane that is changed into; none: the vehicle comes back
    double hold_s = 0.0;              ///< before it comes back
  };
  struct Vehicle {
    Kind kind = Kind::driving;
    std::size_t lane = 0;
    double arc_m = 0.0, speed_mps = 0.0;
    double offset_m = 0.0;  ///< to the left of the middle of its lane
    double shift_m = 0.0;   ///< beside that, by a manoeuvre
    std::optional<Manoeuvre> manoeuvre;
    // The tracker's errors.
    std::uint64_t id = 0;
    bool flipped = false;
    std::array<double, 2> bias{};  ///< in standard deviations
    std::array<Wander, 2> wander;
  };
  struct Ghost {
    Point position;  ///< map frame
    Point velocity;
    std::uint64_t id = 0;
    double left_s = 0.0;
  };

  void spawn(const Point& ego, double nearest_m);
  void drive(Vehicle& vehicle, double dt_s);
  void begin_manoeuvre(Vehicle& vehicle, double dt_s);
  void shift(Vehicle& vehicle, double dt_s);
  /// The lane beside a vehicle, on its left or right, that runs the same way or the other one.
  std::optional<std::size_t> lane_beside(const Vehicle& vehicle, bool left, bool oncoming) const;
  void haunt(const Point& ego, double dt_s);
  Point position(const Vehicle& vehicle) const;
  Point heading(const Vehicle& vehicle) const;
  std::optional<TrackedObject> track(Vehicle& vehicle, const Eigen::Isometry3d& T_body_map, double dt_s);

  TrafficProfile profile_;
  Random random_;
  std::vector<RoadLane> lanes_;
  std::vector<MeasuredPolyline> lines_;               ///< of the lanes
  std::vector<std::vector<std::size_t>> successors_;  ///< of the lanes, by index
  std::vector<Vehicle> vehicles_;
  std::vector<Ghost> ghosts_;
  std::optional<std::int64_t> last_stamp_ns_;
  std::uint64_t next_id_ = 1, sequence_ = 0;
};

}  // namespace laneloom::simulation
