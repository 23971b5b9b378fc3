#pragma once

#include <cstddef>
#include <vector>

#include "drive/lane_tracker.hpp"

namespace laneloom::drive {

/// The route through the true lanes. It gives the driver's wishes for turns, and the places to begin at.
class Navigator {
 public:
  /// The route is the way of the road's drive, and from its end on back to its beginning, or else wherever
  /// lanes lead. `road` and `lanes` must outlive this. Throws std::runtime_error if the drive is on none of
  /// the road's lanes.
  Navigator(const simulation::Road& road, const LaneTracker& lanes);

  struct Start {
    std::size_t lane = 0;
    Bicycle vehicle;  ///< standing on the centerline
  };
  /// The beginning of the drive.
  Start at_begin();
  /// A place on the drive, behind the place where the vehicle left it; at_begin() if it did not leave the
  /// drive before its end.
  Start back_on_drive();
  /// A place on the route, `by_m` or more beyond the vehicle, and in no intersection; at_begin() if the route
  /// ends before.
  Start further_on(const Eigen::Vector2d& from, double by_m);

  /// Follows the vehicle, which is in one of these lanes. If none of them is on the route, it is planned anew
  /// from there. Returns whether a turn was missed.
  bool follow(const std::vector<std::size_t>& lanes);
  /// The turn at the next intersection on the route, or at the one that the vehicle is in.
  struct Turn {
    Linkage::Turn turn = Linkage::Turn::unknown;  ///< unknown: there is no intersection
    double distance_m = 0.0;  ///< along the route from `place` to the intersection's middle; 0: it is past
  };
  Turn next_turn(const Point& place) const;

 private:
  Start start_at(std::size_t lane, double arc_m) const;
  void plan_from(std::size_t lane);
  void extend();
  std::size_t lane_after(std::size_t lane);

  const simulation::Road& road_;
  const LaneTracker& lanes_;
  std::vector<std::size_t> drive_;         // lanes
  std::vector<std::size_t> toward_drive_;  // per lane, the next one on the way back to the drive
  std::vector<std::size_t> route_;         // lanes
  double begin_m_ = 0.0;                   // on the drive's first lane
  std::size_t at_ = 0;                     // place in the route
  std::size_t drive_at_ = 0;               // place in the drive of the route's end
  std::size_t driven_to_ = 0;              // place in the drive of the last lane that was driven on it
};

}  // namespace laneloom::drive
