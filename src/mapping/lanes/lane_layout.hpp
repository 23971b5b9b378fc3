#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <vector>

#include "laneloom/types.hpp"
#include "mapping/boundaries/lane_boundaries.hpp"
#include "mapping/lanes/lane_geometry.hpp"

namespace laneloom::lanes {

/// A place where a lane, the branch, opens or closes beside another lane, the stem, out of which it leads or
/// into which it leads.
struct Fork {
  BoundarySide branch;    ///< the side of their common boundary on which the branch lies
  double arc_m = 0.0;     ///< where the branch has no width, on that boundary
  End end = End::front;   ///< of the branch; front: it opens there
  bool reversed = false;  ///< the boundary runs against the branch
};

/// The number of forks before a lane on its side of a boundary. Lanes on one side of a boundary between which
/// a branch begins do not continue one another.
inline std::size_t forks_before(const LaneSide& side, const std::vector<Fork>& forks) {
  const double middle_m = 0.5 * (side.range.from_m + side.range.to_m);
  return static_cast<std::size_t>(std::ranges::count_if(
      forks, [&](const Fork& fork) { return fork.branch == side.of && fork.arc_m < middle_m; }));
}

/// A stretch between two boundaries, both of which a frame shows, where it says that no lane lies.
struct DeniedStretch {
  std::array<ElementId, 2> borders{kNoElement, kNoElement};  ///< by side
  Polyline middle;                                           ///< map frame
};

/// The lanes of a map with the boundaries that they name.
struct LaneLayout {
  boundaries::Boundaries boundaries;
  std::vector<Lane> lanes;
  std::vector<Fork> forks{};  ///< between lanes beside detected boundaries
  std::vector<DeniedStretch> denied{};
  std::vector<Lane> side_strips{};  ///< strips beside the lanes, which no lane names

  /// The lane of an id. Null: there is none.
  const Lane* find(ElementId id) const {
    const auto found = std::ranges::find(lanes, id, &Lane::id);
    return found == lanes.end() ? nullptr : &*found;
  }
  /// The lane of an id, which must exist.
  const Lane& lane(ElementId id) const {
    const auto found = std::ranges::find(lanes, id, &Lane::id);
    assert(found != lanes.end());
    return *found;
  }
  /// Whether a lane goes round an island that lies on one side of it.
  bool goes_round(const Lane& lane, Side side) const {
    return std::ranges::any_of(lane.borders(side), [&](const Border& border) {
      const boundaries::LaneBoundary* boundary = boundaries.find(border.boundary);
      return boundary != nullptr && boundary->island;
    });
  }
};

}  // namespace laneloom::lanes
