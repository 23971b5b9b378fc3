#pragma once

#include <array>
#include <optional>
#include <vector>

#include "laneloom/types.hpp"

/// The map as a planner looks at it first: from the lane that the vehicle is in.
namespace laneloom::pnc {

inline constexpr std::array<double, 3> kLookahead_m{10.0, 20.0, 30.0};

/// The lane of the vehicle, with its neighbours, its successors and the width ahead.
struct EgoView {
  ElementId lane = kNoElement;            ///< the lane that the vehicle is in; kNoElement: it is in none
  ElementId left_neighbour = kNoElement;  ///< on the left of the vehicle, whichever way the lane runs
  ElementId right_neighbour = kNoElement;
  std::vector<ElementId> successors;  ///< ahead of the vehicle, ascending
  double offset_m = 0.0;              ///< of the vehicle from the centerline, left is positive
  /// Width of the lane at kLookahead_m of the map's way. Empty: it is not known there, or the way ends
  /// before.
  std::array<std::optional<double>, kLookahead_m.size()> width_m;
};

/// Pure. `map` must hold its contract (contract/contract.hpp) as far as geometry and ids go.
EgoView ego_view(const LocalMap& map);

}  // namespace laneloom::pnc
