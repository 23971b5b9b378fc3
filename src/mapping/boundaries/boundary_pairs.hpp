#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mapping/boundaries/road_sections.hpp"

namespace laneloom {

/// From an edge to the line that is painted along it, at most.
inline constexpr double kAlongEdge_m = 1.0;

/// Two boundaries, by their indices, that may bound a lane. It runs as the one does that is not reversed.
struct BoundaryPair {
  std::size_t left = 0, right = 0;
  bool left_reversed = false, right_reversed = false;
  bool adjacent = false;  ///< no other boundary between them, but for what only touches either
  bool near = false;      ///< at most one other
  bool left_kerb = false, right_kerb = false;  ///< an edge, or the line that is painted along it
  bool crosses_kerb = false;                   ///< one is a line along an edge that lies between them
  std::uint32_t section = 0;

  std::size_t index(Side side) const { return side == Side::left ? left : right; }
  bool reversed(Side side) const { return side == Side::left ? left_reversed : right_reversed; }
  /// The side of the boundary, as it runs itself, on which the lane lies.
  Side inner(Side side) const { return as_seen(opposite(side), reversed(side)); }
};

/// Each boundary with those on its right (paper, Sec. III-D-3), but where a whole row of others lies between.
/// Neighbours first; of two that are opposed, the lane runs as the older one.
std::vector<BoundaryPair> boundary_pairs(const SectionGraph& graph);

}  // namespace laneloom
