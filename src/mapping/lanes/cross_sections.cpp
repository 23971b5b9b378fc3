#include "mapping/lanes/cross_sections.hpp"

#include <algorithm>

#include "mapping/geometry/stretches.hpp"

namespace laneloom::lanes {
namespace {

/// Appends a stretch. Extends the last range if the stretch follows it directly.
void append(std::vector<Stretch>& ranges, const Stretch& stretch) {
  if (!ranges.empty() && ranges.back().to_m == stretch.from_m) {
    ranges.back().to_m = stretch.to_m;
  } else {
    ranges.push_back(stretch);
  }
}

/// What a border tells. An inferred line tells nothing; an edge that is continued was seen before.
Evidence evidence_of(const Marking& border) {
  if (border.type == MarkingType::roadedge) return Evidence::edges;
  return border.status == ElementStatus::inferred ? Evidence::none : Evidence::markings;
}

/// Gives a lane the evidence of its two markings, and the status and existence probability of the less sure
/// of them.
void set_trust(const Marking& left, const Marking& right, Lane& lane) {
  const auto either = [&](ElementStatus status) { return left.status == status || right.status == status; };
  lane.status = either(ElementStatus::inferred)    ? ElementStatus::inferred
                : either(ElementStatus::tentative) ? ElementStatus::tentative
                                                   : ElementStatus::confirmed;
  lane.existence_probability = std::min(left.existence_probability, right.existence_probability);
  lane.evidence = evidence_of(left) | evidence_of(right);
}

Border border_of(const LaneBorder& border, const Stretch& along_lane, double lane_m) {
  return {border.marking().id, {0.0, lane_m}, border.own(along_lane), border.reversed()};
}

}  // namespace

LaneBorder::LaneBorder(const boundaries::LaneBoundary& boundary, bool reversed)
    : boundary_(boundary), reversed_(reversed) {
  const Polyline& points = boundary.course.points();
  if (reversed) turned_ = MeasuredPolyline(Polyline(points.rbegin(), points.rend()));
}

bool LaneBorder::is_bridged(double arc_m) const { return geometry::contains(boundary_.bridged, own(arc_m)); }

Lane make_lane(std::span<const CrossSection> run, const LaneBorder& left, const LaneBorder& right) {
  Lane lane{.use = Lane::Use::lane};
  set_trust(left.marking(), right.marking(), lane);
  // Sides and centerline have their points at the cross-sections, so that they never cross, wherever the
  // boundaries' own vertices are.
  for (Polyline* line : {&lane.left, &lane.right, &lane.centerline}) line->reserve(run.size());
  double width_sum_m = 0.0, arc_m = 0.0;
  for (const CrossSection& section : run) {
    width_sum_m += section.width_m;
    const Point center = section.middle();
    const double from_m = arc_m;
    if (!lane.centerline.empty()) arc_m += (center - lane.centerline.back()).head<2>().norm();
    if (left.is_bridged(section.left_arc_m) || right.is_bridged(section.right_arc_m))
      append(lane.inferred_ranges, {from_m, arc_m});
    lane.left.push_back(section.left);
    lane.right.push_back(section.right);
    lane.centerline.push_back(center);
  }
  drop_repeats(lane.left);
  lane.width_m = width_sum_m / static_cast<double>(run.size());
  lane.left_borders = {
      border_of(left, {run.front().left_arc_m, run.back().left_arc_m}, length(lane.centerline))};
  lane.right_borders = {
      border_of(right, {run.front().right_arc_m, run.back().right_arc_m}, length(lane.centerline))};
  std::erase_if(lane.inferred_ranges, [](const Stretch& range) { return range.length() <= 0.0; });
  return lane;
}

}  // namespace laneloom::lanes
