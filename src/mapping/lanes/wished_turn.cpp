#include "mapping/lanes/wished_turn.hpp"

#include <algorithm>
#include <utility>

namespace laneloom::lanes {
namespace {

using Turn = Linkage::Turn;

constexpr double kBefore_m = 30.0, kBehind_m = 15.0;  // the middle of the intersection

WayWish wish_of(Turn turn) {
  if (turn == Turn::left) return WayWish::left;
  return turn == Turn::right ? WayWish::right : WayWish::straight;
}

}  // namespace

WishedTurn::WishedTurn(const NextTurn& turn, Point place)
    : wish_(wish_of(turn.turn)), distance_m_(turn.distance_m), place_(std::move(place)) {}

Stretch WishedTurn::range() const { return {distance_m_ - kBefore_m, distance_m_ + kBehind_m}; }

void WishedTurn::drive_to(const Point& place) {
  distance_m_ -= (place - place_).head<2>().norm();
  place_ = place;
}

bool WishedTurn::is_over(const Way* before, const Way* now) const {
  if (wish_ == WayWish::straight) return false;
  if (range().to_m < 0.0) return true;
  if (before == nullptr || now == nullptr) return false;
  const Turn turn = wish_ == WayWish::left ? Turn::left : Turn::right;
  return std::ranges::any_of(before->lanes, [&](const WayLane& lane) {
    return lane.entry == turn && lane.id == now->stations.front().lane;
  });
}

}  // namespace laneloom::lanes
