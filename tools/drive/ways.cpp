#include "drive/ways.hpp"

#include <algorithm>

#include "drive/lines.hpp"

namespace laneloom::drive {
namespace {

constexpr double kGoesOn_m = 8.0;
constexpr double kNarrowed = 0.77;

/// Whether most of the line between a lane and its neighbour may be crossed.
bool is_crossable(const Neighbour& neighbour) {
  double crossable_m = 0.0;
  for (const Stretch& range : neighbour.crossable) crossable_m += range.length();
  return crossable_m > 0.5 * neighbour.range.length();
}

/// Whether a lane narrows at its end, as a lane does that really ends. A lane of which only the view ends
/// does not narrow.
bool narrows(const DirectedLane& lane) {
  Polyline left = lane.lane->left, right = lane.lane->right;
  if (lane.against) {
    std::ranges::reverse(left);
    std::ranges::reverse(right);
  }
  const MeasuredPolyline other(right);
  double widest_m = 0.0;
  for (const Point& point : left) widest_m = std::max(widest_m, other.project(point).distance_m);
  return (left.back() - right.back()).head<2>().norm() < kNarrowed * widest_m;
}

bool goes_on_beyond(const LaneGraph& graph, const DirectedLane& lane, const Point& end) {
  const MeasuredPolyline line(lane.centerline());
  const Projection foot = line.project(end);
  if (!foot.inside) return false;
  return line.length() - foot.arc_m > kGoesOn_m || !graph.successors(lane).empty();
}

}  // namespace

std::vector<Passage> passages(const LaneGraph& graph, const DirectedLane& lane) {
  std::vector<Passage> all = graph.successors(lane);
  for (Passage& passage : all)
    if (passage.path.empty()) passage.path = bridge(lane.centerline(), passage.to.centerline());
  return all;
}

DirectedLane lane_to_change_to(const LaneGraph& graph, const DirectedLane& lane) {
  if (!narrows(lane)) return {};
  const Point end = lane.centerline().back();
  for (const Side side : kSides) {
    for (const Neighbour& neighbour : neighbours(*lane.lane, side)) {
      const DirectedLane candidate{graph.find(neighbour.lane), lane.against};
      if (candidate.lane == nullptr || candidate.oncoming() || !is_crossable(neighbour)) continue;
      if (goes_on_beyond(graph, candidate, end)) return candidate;
    }
  }
  return {};
}

}  // namespace laneloom::drive
