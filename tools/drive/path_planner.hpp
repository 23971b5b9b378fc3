#pragma once

#include <cstdint>
#include <vector>

#include "drive/bicycle.hpp"
#include "laneloom/types.hpp"

namespace laneloom {

/// What a stretch of a plan rests on.
enum class Support : std::uint8_t {
  mapped,      ///< the present map gives the way
  remembered,  ///< an earlier map gave it
  guessed      ///< none did: it goes on as the way before it ended
};

/// From which lane into which the vehicle goes next.
struct Passing {
  ElementId from = kNoElement;  ///< none: it follows no lane to its end
  bool against = false;         ///< the order of its points
  ElementId into = kNoElement;
  bool between = false;  ///< it is in neither
};

/// The way that the vehicle means to go.
struct Plan {
  Polyline path;                 ///< map frame, from a little behind the vehicle on; empty: no plan yet
  std::vector<Support> support;  ///< of every point
  Passing passing;
  bool looks_for_turn = false;  ///< the lane ends soon, and the wanted turn is not in the map (yet)

  /// At the point nearest to a place; guessed for an empty plan.
  Support support_at(const Point& place) const;
};

/// Where the vehicle goes on a map: along the lane that the previous plan runs on, then across passages and
/// along successors. `wanted` is the turn at the next intersection that the driver asks for. A passage that
/// is begun is kept to as long as the map has it, but for the wanted one where that has not parted from it
/// yet.
///
/// The plan begins as the previous one does beside the vehicle, and bends to the way smoothly. Where the map
/// gives no way, the previous plan stays where it is in the map frame, and goes on from its end with a
/// curvature that fades. Pure.
Plan next_plan(const LocalMap& map, const Bicycle& vehicle, const Plan& previous, Linkage::Turn wanted);

}  // namespace laneloom
