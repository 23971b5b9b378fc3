#include "mapping/lanes/lane_changes.hpp"

#include <algorithm>

namespace laneloom::lanes {

LaneChanges::LaneChanges(const LaneGraph& graph, const DirectedLane& lane)
    : graph_(graph), lane_(lane), line_(lane.lane->centerline) {}

bool LaneChanges::runs_along(const Lane& other, double at_m) const {
  const MeasuredPolyline line(other.centerline);
  return line.direction(line.project(line_.at(at_m))).dot(line_.direction(at_m)) >= 0.0;
}

DirectedLane LaneChanges::at(Side side, double arc_m) const {
  const double at_m = lane_.against ? line_.length() - arc_m : arc_m;
  for (const Neighbour& neighbour : neighbours(*lane_.lane, as_seen(side, lane_.against))) {
    const bool is_crossable = std::ranges::any_of(neighbour.crossable, [&](const Stretch& stretch) {
      return stretch.from_m <= at_m && at_m <= stretch.to_m;
    });
    const Lane* other = is_crossable ? graph_.find(neighbour.lane) : nullptr;
    if (other == nullptr || !other->is_drivable()) continue;
    DirectedLane& known = last_[index(side)];
    if (known.lane != other) known = {other, lane_.against == runs_along(*other, at_m)};
    if (!known.oncoming()) return known;
  }
  return {};
}

}  // namespace laneloom::lanes
