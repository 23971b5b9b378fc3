#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "laneloom/next_turn.hpp"
#include "laneloom/way.hpp"

namespace laneloom::lanes {

/// The wish for a turn; straight on, where it is neither left nor right.
WayWish wish_of(Linkage::Turn turn);

/// The next turn of the route, as the vehicle comes nearer to it.
class WishedTurn {
 public:
  WishedTurn() = default;  ///< straight on
  /// `place` is that of the vehicle at the stamp of the turn, map frame.
  WishedTurn(const NextTurn& turn, const Point& place);

  WayWish wish() const { return wish_; }
  /// Where the lane ends from which the turn is made, ahead of the vehicle. A lane ends before the middle of
  /// the intersection, and a navigation's distance is wrong by some metres.
  Stretch range() const;

  /// The vehicle has driven on; backwards, the turn is further again.
  void drive_to(const Eigen::Isometry3d& T_map_body);
  /// Whether the vehicle has turned, or is past the place. `before` was the way of the map before.
  bool is_over(const Way* before, const Way* now) const;

  /// The poses have jumped: where the vehicle was is not known.
  void forget_place() { place_.reset(); }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(wish_, distance_m_, place_);
  }

 private:
  WayWish wish_ = WayWish::straight;
  double distance_m_ = 0.0;     ///< to the middle of the intersection
  std::optional<Point> place_;  ///< of the vehicle, map frame
};

}  // namespace laneloom::lanes
