#pragma once

#include <cstddef>
#include <vector>

#include "drive/lane_tracker.hpp"

namespace laneloom {

/// The route through the true lanes, which gives the driver's wishes for turns, and says where to begin.
class Navigator {
 public:
  /// The route is the way of the road's drive, and from its end on back to it, or else wherever lanes lead.
  /// `road` and `lanes` must outlive this. Throws std::runtime_error where the drive is on none of the road's
  /// lanes.
  Navigator(const Road& road, const LaneTracker& lanes);

  struct Start {
    std::size_t lane = 0;
    Bicycle vehicle;  ///< standing on the centerline
  };
  /// Where the drive begins.
  Start at_begin();
  /// On the drive, behind where the vehicle left it; at_begin() where it did not, before the drive's end.
  Start back_on_drive();
  /// On the route, so far beyond where the vehicle is, and in no intersection; at_begin() where it ends
  /// before.
  Start further_on(const Eigen::Vector2d& from, double by_m);

  /// The vehicle is in one of these lanes. When none of them is on the route, it is planned anew from there;
  /// tells whether a turn was missed.
  bool follow(const std::vector<std::size_t>& lanes);
  /// At the next intersection on the route, or the one that the vehicle is in; unknown where there is none.
  Linkage::Turn wanted_turn() const;

 private:
  Start start_at(std::size_t lane, double arc_m) const;
  void plan_from(std::size_t lane);
  void extend();
  std::size_t lane_after(std::size_t lane);

  const Road& road_;
  const LaneTracker& lanes_;
  std::vector<std::size_t> drive_;         // lanes
  std::vector<std::size_t> toward_drive_;  // of every lane, the next one on the way back to the drive
  std::vector<std::size_t> route_;         // lanes
  double begin_m_ = 0.0;                   // on the drive's first lane
  std::size_t at_ = 0;                     // in the route
  std::size_t drive_at_ = 0;               // in the drive, of the route's end
  std::size_t driven_to_ = 0;              // in the drive, of the last lane that was driven on it
};

}  // namespace laneloom
