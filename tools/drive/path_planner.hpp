#pragma once

#include <cstdint>
#include <vector>

#include "drive/bicycle.hpp"
#include "laneloom/types.hpp"

namespace laneloom::drive {

/// The support of a stretch of a plan.
enum class Support : std::uint8_t {
  mapped,      ///< the present map gives the way
  remembered,  ///< an earlier map gave it
  guessed      ///< no map gave it: it continues the way before
};

/// The next change of the vehicle from one lane into another.
struct Passing {
  ElementId from = kNoElement;  ///< kNoElement: it follows no lane to its end
  bool against = false;         ///< `from` is followed against the order of its points
  ElementId into = kNoElement;
  bool between = false;  ///< the vehicle is in neither of the two
};

/// The path that the vehicle plans to take.
struct Plan {
  Polyline path;                 ///< map frame, from a little behind the vehicle on; empty: no plan yet
  std::vector<Support> support;  ///< per point
  Passing passing;
  bool looks_for_turn = false;  ///< the lane ends soon, and the wanted turn is not yet in the map

  /// The support at the point nearest to a place; guessed if the plan is empty.
  Support support_at(const Point& place) const;
};

/// Plans the way of the vehicle on a map: along the lane that the previous plan runs on, then across passages
/// and along successors. `wanted` is the turn at the next intersection that the driver asks for. A passage
/// that was begun is kept as long as the map has it. It is left for the wanted one if the two have not parted
/// yet.
///
/// The plan begins beside the vehicle as the previous one, and bends to the way smoothly. If the map gives no
/// way, the previous plan stays where it is in the map frame, and is prolonged with a curvature that fades.
/// Pure.
Plan next_plan(const LocalMap& map, const Bicycle& vehicle, const Plan& previous, Linkage::Turn wanted);

}  // namespace laneloom::drive
