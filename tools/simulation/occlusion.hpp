#pragma once

#include <vector>

#include "laneloom/types.hpp"
#include "simulation/noise_profile.hpp"
#include "simulation/random.hpp"
#include "simulation/sensor_view.hpp"

namespace laneloom::simulation {

/// Other vehicles that come, move along and go, and the areas that they hide from the sensor at the body's
/// origin.
class Occluders {
 public:
  void step(double dt_s, const NoiseProfile& noise, Random& random);

  /// The area of each vehicle and the area behind it: convex, counter-clockwise, body frame.
  const std::vector<Polyline>& areas() const { return areas_; }

  /// The parts of a piece of a line that are outside of all areas.
  std::vector<VisiblePiece> visible_parts(const VisiblePiece& piece) const;

 private:
  struct Vehicle {
    Point centre;      // body frame
    double speed_mps;  // relative to ours
    double length_m, width_m;
  };
  static Polyline hidden_area(const Vehicle& vehicle);
  std::vector<Vehicle> vehicles_;
  std::vector<Polyline> areas_;
};

}  // namespace laneloom::simulation
