#pragma once

#include <array>
#include <optional>
#include <vector>

#include "laneloom/types.hpp"

/// The map as a planner looks at it first: from the lane that the vehicle is in.
namespace laneloom {

inline constexpr std::array<double, 3> kLookahead_m{10.0, 20.0, 30.0};

struct EgoView {
  ElementId lane = kNoElement;            ///< that the vehicle is in; none: in no lane of the map
  ElementId left_neighbour = kNoElement;  ///< left as the vehicle looks, whatever way the lane is given
  ElementId right_neighbour = kNoElement;
  std::vector<ElementId> successors;  ///< ahead of the vehicle, ascending
  double offset_m = 0.0;              ///< of the vehicle from the centerline, left is positive
  /// Width of the way ahead, kLookahead_m from the vehicle along the centerlines of its lane and of the
  /// lanes straight ahead; none where they end before.
  std::array<std::optional<double>, kLookahead_m.size()> width_m;
};

/// Pure. `map` must hold its contract (contract/contract.hpp) as far as geometry and ids go.
EgoView ego_view(const LocalMap& map);

}  // namespace laneloom
