#pragma once

#include <cstddef>
#include <vector>

#include "mapping/lanes/lane_layout.hpp"

namespace laneloom {

/// Two lanes, by their indices, that lie side by side and run alike as they are given.
struct SideBySideLanes {
  std::size_t left = 0, right = 0;
  double opposed = 0.0;   ///< log odds that their traffic runs in opposite directions
  bool may_part = false;  ///< they may be of two roads, each with its own left and right
};

/// The lanes side by side, with what the boundary between two of them says of their directions: a solid line
/// speaks for opposite ones, most of all in the middle of the road (elsewhere it may divide off lanes for
/// buses or for turning); a dashed line speaks against them, an edge for them. So do two solid lines or edges
/// with nothing but a median between them, which run parallel: what diverges are the roads of an exit. Beyond
/// a wide median there may also be another road. Ours.
std::vector<SideBySideLanes> side_by_side(const LaneLayout& layout);

}  // namespace laneloom
