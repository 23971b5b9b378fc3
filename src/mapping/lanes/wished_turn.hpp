#pragma once

#include "laneloom/next_turn.hpp"
#include "laneloom/way.hpp"

namespace laneloom::lanes {

/// The next turn of the route, as the vehicle comes nearer to it.
class WishedTurn {
 public:
  WishedTurn() = default;  ///< straight on
  /// `place` is that of the vehicle at the stamp of the turn.
  WishedTurn(const NextTurn& turn, Point place);

  WayWish wish() const { return wish_; }
  /// Where the lane ends that is left for the turn, ahead of the vehicle. A lane ends before the middle of
  /// the intersection, and a navigation's distance is wrong by some metres.
  Stretch range() const;

  /// The vehicle has driven on.
  void drive_to(const Point& place);
  /// Whether the vehicle has turned, or is past the place. `before` was the way of the map before.
  bool is_over(const Way* before, const Way* now) const;

  /// Moves the place of the vehicle, map frame.
  void move(const Eigen::Isometry3d& motion) { place_ = motion * place_; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(wish_, distance_m_, place_);
  }

 private:
  WayWish wish_ = WayWish::straight;
  double distance_m_ = 0.0;      ///< to the middle of the intersection
  Point place_ = Point::Zero();  ///< of the vehicle, map frame
};

}  // namespace laneloom::lanes
