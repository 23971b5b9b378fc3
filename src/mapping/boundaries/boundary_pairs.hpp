#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mapping/boundaries/road_sections.hpp"

namespace laneloom::boundaries {

/// Two boundaries, by their indices, that may bound a lane. The lane runs as the boundary does that is not
/// reversed.
struct BoundaryPair {
  std::size_t left = 0, right = 0;
  bool left_reversed = false, right_reversed = false;
  std::uint32_t section = 0;  ///< index of the road section

  std::size_t index(Side side) const { return side == Side::left ? left : right; }
  bool reversed(Side side) const { return side == Side::left ? left_reversed : right_reversed; }
  /// The side of a boundary on which the lane lies, as the boundary itself runs.
  Side inner(Side side) const { return as_seen(opposite(side), reversed(side)); }
};

/// Pairs of each boundary with the next two on its right (paper, Sec. III-D-3). Boundaries that only touch
/// the space between two others do not count. Pairs with nothing between come first. Between two boundaries
/// that run against each other, the lane runs as the older one does.
std::vector<BoundaryPair> boundary_pairs(const SectionGraph& graph);

}  // namespace laneloom::boundaries
