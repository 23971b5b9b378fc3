#pragma once

#include <algorithm>
#include <cassert>
#include <vector>

#include "laneloom/types.hpp"
#include "mapping/boundaries/lane_boundaries.hpp"

namespace laneloom::lanes {

/// The lanes of a map with the boundaries that they name.
struct LaneLayout {
  boundaries::Boundaries boundaries;
  std::vector<Lane> lanes;

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
};

}  // namespace laneloom::lanes
