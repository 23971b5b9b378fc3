#pragma once

#include <vector>

#include "simulation/noise_profile.hpp"
#include "simulation/random.hpp"
#include "simulation/road.hpp"
#include "simulation/sensor_view.hpp"

namespace laneloom::simulation {

/// Lines that a network sees where none are. They stay in their places on the map, for a moment or for long.
class Ghosts {
 public:
  explicit Ghosts(const Road& road);

  /// Lets ghosts come and go. `in_view` are the parts in view of markings along roads (body frame).
  void step(const VehiclePose& pose, const std::vector<Polyline>& in_view, double dt_s,
            const NoiseProfile& noise, const SensorView& view, Random& random);

  /// The detections of the ghosts (body frame).
  std::vector<Detection> detections(const VehiclePose& pose, const NoiseProfile& noise,
                                    const SensorView& view, Random& random) const;

 private:
  struct Ghost {
    Polyline points_map;
    MarkingType type;
    MarkingStyle style;
    double dwell_s;
    Wander confidence;
  };
  void appear_at_intersection(const VehiclePose& pose, const NoiseProfile& noise, const SensorView& view,
                              Random& random);
  void appear(MarkingType type, Polyline points_map, const NoiseProfile& noise, Random& random);

  std::vector<ViewedLine> crossings_;  // borders of the lanes in intersections
  std::vector<Ghost> ghosts_;
};

}  // namespace laneloom::simulation
