#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mapping/lanes/lane_layout.hpp"

namespace laneloom::topology {

/// Two lanes that lie side by side, by their indices. Their centerlines run alike.
struct SideBySideLanes {
  std::size_t left = 0, right = 0;
  double opposed = 0.0;   ///< log odds that their traffic runs in opposite directions
  bool may_part = false;  ///< they may belong to two roads, each with its own driving side
};

/// Finds lanes side by side, and the evidence of the boundary between them on their directions. A solid line
/// speaks for opposite directions, most of all in the middle of the road; elsewhere it may divide off lanes
/// for buses or for turning. A dashed line speaks against opposite directions, an edge for them. Two parallel
/// solid lines or edges with only a median between them speak for them too; if they diverge, they belong to
/// the roads of an exit. Beyond a wide median there may also be another road. `own_way` has places of the
/// vehicle, map frame, the last one last. Ours.
std::vector<SideBySideLanes> side_by_side(const lanes::LaneLayout& layout,
                                          std::span<const Point> own_way = {});

/// Whether the road may have another lane beyond the outermost one of a side, where none was found: its
/// border there is no edge, and the next boundary beyond it is further away than a shoulder is wide. Or the
/// vehicle drives there.
bool goes_on_beyond(const lanes::LaneLayout& layout, const Lane& lane, Side side,
                    std::span<const Point> own_way);

}  // namespace laneloom::topology
