#pragma once

#include <array>

#include "laneloom/lane_graph.hpp"

namespace laneloom::lanes {

/// The places where a lane may be left for the one beside it.
class LaneChanges {
 public:
  /// `graph` must outlive this.
  LaneChanges(const LaneGraph& graph, const DirectedLane& lane);

  /// The lane on a side to change to at an arc length of the lane, both as it is walked. Its lane is null
  /// where there is none, where the line between may not be crossed, where it is known to be oncoming, and
  /// where it is no lane to drive in.
  DirectedLane at(Side side, double arc_m) const;

 private:
  bool runs_along(const Lane& other, double at_m) const;

  const LaneGraph& graph_;
  DirectedLane lane_;
  MeasuredPolyline line_;  // as the lane's points run
  mutable std::array<DirectedLane, 2> last_;
};

}  // namespace laneloom::lanes
