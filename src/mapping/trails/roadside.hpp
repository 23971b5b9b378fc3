#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "laneloom/objects.hpp"
#include "laneloom/types.hpp"
#include "mapping/trails/trails.hpp"

namespace laneloom::trails {

/// What others do beside the lanes: where vehicles stand, and where cyclists ride. It tells what the strips
/// at the side of a road are for. Ours.
class Roadside {
 public:
  /// Takes the objects of one message, in the body frame, at the vehicle's pose at their stamp. The order of
  /// messages is that of Trails.
  void add(const TrackedObjects& objects, const Eigen::Isometry3d& T_map_body);
  /// Forgets what lies further from the vehicle than it will be of use.
  void keep_around(const Point& vehicle);

  /// Places of vehicles that stood when they were seen last, map frame, further apart than a vehicle is long.
  const std::vector<Point>& standing() const { return standing_; }
  const std::vector<Trail>& cyclists() const { return cyclists_.all(); }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(standing_, cyclists_);
  }

 private:
  std::vector<Point> standing_;
  Trails cyclists_{Trails::Of::cyclists};
};

}  // namespace laneloom::trails
