#include "mapping/lanes/inferred_boundaries.hpp"

#include <algorithm>
#include <utility>

#include "mapping/geometry/levels.hpp"

namespace laneloom::lanes {

std::vector<Marking*> markings_of(std::vector<InferredBoundary>& inferred) {
  std::vector<Marking*> markings;
  markings.reserve(inferred.size());
  for (InferredBoundary& one : inferred) markings.push_back(&one.marking);
  return markings;
}

Marking inferred_marking(const Polyline& points) {
  return {.status = ElementStatus::inferred,
          .points = points,
          .styles = {{{0.0, length(points)}, MarkingStyle::unknown}}};
}

void TakenSpace::add(const Polyline& line, double half_width_m) {
  strips_.push_back({MeasuredPolyline(line), half_width_m, box_around(line, half_width_m)});
}

bool TakenSpace::contains(const Point& point) const {
  return std::ranges::any_of(strips_, [&](const Strip& strip) {
    if (!strip.box.contains(point)) return false;
    const Projection foot = strip.line.project(point, strip.half_width_m);
    return foot.inside && foot.distance_m < strip.half_width_m && geometry::same_level(foot.foot, point);
  });
}

LaneLayout laid_out(FoundLanes found) {
  LaneLayout layout{.boundaries = {},
                    .lanes = std::move(found.lanes),
                    .forks = std::move(found.forks),
                    .denied = std::move(found.denied),
                    .side_strips = std::move(found.side_strips)};
  std::vector<boundaries::LaneBoundary> added;
  for (InferredBoundary& one : found.inferred) {
    added.push_back({.marking = one.marking, .members = {one.marking.id}, .two_way = one.two_way});
    const LaneBorder border(added.back(), false);
    const auto other = [&](const InferredBoundary::Beside& lane) {
      return LaneBorder(found.boundaries[lane.boundary], lane.reversed);
    };
    const auto add_lane = [&](Lane lane) {
      lane.section = one.section;
      lane.inferred_ranges = {{0.0, length(lane.centerline)}};
      layout.lanes.push_back(std::move(lane));
    };
    const std::vector<double> arcs_m = arc_lengths(one.marking.points);
    for (std::size_t i = 0; i < arcs_m.size(); ++i) {
      if (one.on_left) one.on_left->sections[i].right_arc_m = arcs_m[i];
      if (one.on_right) one.on_right->sections[i].left_arc_m = arcs_m[i];
    }
    if (one.on_left) add_lane(make_lane(one.on_left->sections, other(*one.on_left), border));
    if (one.on_right) add_lane(make_lane(one.on_right->sections, border, other(*one.on_right)));
  }
  layout.boundaries = std::move(found.boundaries);
  layout.boundaries.insert(std::move(added));
  return layout;
}

}  // namespace laneloom::lanes
