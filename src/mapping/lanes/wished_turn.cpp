#include "mapping/lanes/wished_turn.hpp"

#include <algorithm>

#include "mapping/lanes/way_passages.hpp"

namespace laneloom::lanes {
namespace {

using Turn = Linkage::Turn;

constexpr double kBefore_m = 30.0, kBehind_m = 15.0;  // the middle of the intersection

}  // namespace

WayWish wish_of(Turn turn) {
  if (turn == Turn::left) return WayWish::left;
  return turn == Turn::right ? WayWish::right : WayWish::straight;
}

WishedTurn::WishedTurn(const NextTurn& turn, const Point& place)
    : wish_(wish_of(turn.turn)), distance_m_(turn.distance_m), place_(place) {}

Stretch WishedTurn::range() const { return {distance_m_ - kBefore_m, distance_m_ + kBehind_m}; }

void WishedTurn::drive_to(const Eigen::Isometry3d& T_map_body) {
  const Point place = T_map_body.translation();
  if (place_) distance_m_ -= T_map_body.linear().col(0).dot(place - *place_);
  place_ = place;
}

bool WishedTurn::is_over(const Way* before, const Way* now) const {
  if (wish_ == WayWish::straight) return false;
  if (range().to_m < 0.0) return true;
  if (range().from_m > 0.0 || before == nullptr || now == nullptr) return false;
  return std::ranges::any_of(before->lanes, [&](const WayLane& lane) {
    return lane.entry == turn_of(wish_) && lane.id == now->stations.front().lane;
  });
}

}  // namespace laneloom::lanes
