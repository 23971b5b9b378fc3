#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "laneloom/polyline.hpp"
#include "laneloom/types.hpp"

/// The way that a planner takes from one map: on along what the vehicle drives in, then along the linkage
/// that leads straightest, and so on. All is seen from above.
namespace laneloom::evaluation {

/// A place where a way passes from one lane, or path of a linkage, to what follows it.
struct Joint {
  double gap_m = 0.0;   ///< from the end of the one to the begin of the other
  double step_m = 0.0;  ///< the part of the gap across the way
};

/// The way ahead. It begins beside the vehicle, at the foot on what the vehicle drives in.
struct Way {
  Polyline points;            ///< map frame; empty: the vehicle drives in no lane and on no path
  std::vector<Joint> joints;  ///< in the order of the way
  ElementId lane =
      kNoElement;  ///< the vehicle drives in it; kNoElement: the way begins on the path of a linkage
};

/// The way in a map. The vehicle drives in the nearest lane under it, which is half the lane's width to
/// either side and runs at less than 45 degrees to the vehicle, or in the opposite sense. Of a lane in the
/// opposite sense, the way goes to its first point and not beyond. Without a lane, the way runs along the
/// nearest path of a linkage under the vehicle, in the sense of the path. No lane is taken up once the way is
/// `horizon_m` long.
Way way_ahead(const LocalMap& map, const Eigen::Isometry3d& T_map_body, double horizon_m = 40.0);

/// The largest change of direction of a line within 4 m, from the first 2 m of them to the others.
double largest_kink_deg(const Polyline& line);

}  // namespace laneloom::evaluation
