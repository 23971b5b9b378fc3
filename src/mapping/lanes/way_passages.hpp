#pragma once

#include <optional>
#include <vector>

#include "laneloom/lane_graph.hpp"
#include "laneloom/way.hpp"

/// The passages that a way takes from lane to lane.
namespace laneloom::lanes {

/// A place from which a route leads on.
struct RouteStart {
  DirectedLane lane;
  double arc_m = 0.0;           ///< along the lane, as it is walked
  ElementId into = kNoElement;  ///< on the passage from the lane's end into this lane, if not kNoElement
  double passed_m = 0.0;        ///< of that passage
};

/// What decides where lanes fork.
struct RouteWish {
  WayWish wish = WayWish::straight;
  const Way* before = nullptr;         ///< null: there is none
  std::optional<Stretch> turn_m = {};  ///< where the wished turn is, as in WayOptions
  bool any_turn = false;  ///< another turn than the wished one is taken where the road may lead straight on
};

/// The passages ahead, one after the other.
struct Passages {
  std::vector<Passage> all;
  bool has_turned = false;  ///< one of them makes the wished turn

  /// The turn that is wished behind them, at the end of a lane `ahead_m` ahead of the vehicle.
  Linkage::Turn wished(const RouteWish& wish, double ahead_m) const;
};

/// The turn that a wish asks for; straight on, where it asks for none.
Linkage::Turn turn_of(WayWish wish);

/// The lane of a way, walked in the same sense. Null: the way does not lead through it, or is null.
const WayLane* find(const Way* way, const DirectedLane& lane);

/// The passages over `reach_m` from the beginning of the lane of a start. The first one leads into `into`, if
/// that is a lane.
Passages passages_ahead(const LaneGraph& graph, const RouteStart& start, const RouteWish& wish,
                        double reach_m);

}  // namespace laneloom::lanes
