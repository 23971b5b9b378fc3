#include "mapping/lanes/cross_sections.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mapping/geometry/levels.hpp"
#include "mapping/geometry/stretches.hpp"

namespace laneloom::lanes {
namespace {

constexpr double kNarrow_m = 2.5;  // a lane is narrower only if it is so from end to end
constexpr double kMinAlong = 0.9;  // cosine between a line and the boundaries that it runs along
constexpr double kTaper_m = 0.3;   // a run that grows this much beyond kNarrow_m loses its narrow ends

/// The end of the longest run from `begin` in which the width varies little and the left boundary is followed
/// forwards.
std::size_t run_end(const std::vector<CrossSection>& sections, std::size_t begin, double max_variation_m) {
  double narrowest = std::numeric_limits<double>::infinity(), widest = 0.0;
  std::size_t end = begin;
  while (end < sections.size() && sections[end].valid) {
    if (end > begin && sections[end].left_arc_m < sections[end - 1].left_arc_m) break;
    if (sections[end].wide != sections[begin].wide) break;
    narrowest = std::min(narrowest, sections[end].width_m);
    widest = std::max(widest, sections[end].width_m);
    if (widest - narrowest > max_variation_m) break;
    ++end;
  }
  return end;
}

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

LaneBorder::LaneBorder(const boundaries::LaneBoundary& boundary, bool reversed, const Occupied& occupied)
    : boundary_(boundary), reversed_(reversed), occupied_(occupied) {
  const Polyline& points = boundary.course.points();
  if (reversed) turned_ = MeasuredPolyline(Polyline(points.rbegin(), points.rend()));
}

bool LaneBorder::is_free(double arc_m) const { return !geometry::contains(occupied_, own(arc_m)); }

bool LaneBorder::is_bridged(double arc_m) const { return geometry::contains(boundary_.bridged, own(arc_m)); }

std::optional<Between> find_between(const CrossSection& section, const boundaries::BoundaryPair& pair,
                                    const boundaries::Boundaries& boundaries) {
  const Point middle = section.middle();
  const Eigen::Vector2d across = (section.right - section.left).head<2>();
  const double width_m = across.norm(), reach_m = 0.5 * width_m - boundaries::kAlongEdge_m;
  std::optional<Between> line;
  for (std::size_t i = 0; i < boundaries.size(); ++i) {
    if (i == pair.left || i == pair.right) continue;
    const boundaries::LaneBoundary& boundary = boundaries[i];
    if (!boundary.is_edge() && !boundary.is_confirmed()) continue;
    const Projection foot = boundary.course.project(middle, reach_m);
    if (!foot.inside || foot.distance_m >= reach_m || !geometry::same_level(foot.foot, middle)) continue;
    const double share = (foot.foot - section.left).head<2>().dot(across) / (width_m * width_m);
    if (boundary.is_edge()) return Between{true, share};
    if (std::abs(cross(boundary.course.direction(foot), across)) > kMinAlong * width_m)
      line = Between{false, share};
  }
  return line;
}

std::vector<CrossSection> cross_sections(const LaneBorder& left, const LaneBorder& right,
                                         const WidthLimits& limits, const LaneConfig& config) {
  const Polyline points = right.line().resample(config.step_m);
  std::vector<CrossSection> sections(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double arc_m =
        right.line().length() * static_cast<double>(i) / static_cast<double>(points.size() - 1);
    if (!right.is_free(arc_m)) continue;
    const Projection foot = left.line().project(points[i], limits.max_m);
    if (!foot.inside || foot.distance_m < limits.min_m || foot.lateral_m >= 0.0) continue;
    if (!left.is_free(foot.arc_m)) continue;
    sections[i] = {.left_arc_m = foot.arc_m,
                   .right_arc_m = arc_m,
                   .width_m = foot.distance_m,
                   .wide = foot.distance_m > config.max_width_m,
                   .left = foot.foot,
                   .right = points[i],
                   .valid = true};
  }
  return sections;
}

std::span<const CrossSection> next_run(const std::vector<CrossSection>& sections, std::size_t& begin,
                                       double max_variation_m) {
  const auto is_narrow = [](const CrossSection& section) { return section.width_m < kNarrow_m; };
  const auto run_from = [&](std::size_t first) {
    return std::span(sections).subspan(
        first, std::max(run_end(sections, first, max_variation_m), first + 1) - first);
  };
  auto run = run_from(begin);
  if (std::ranges::max_element(run, {}, &CrossSection::width_m)->width_m >= kNarrow_m + kTaper_m) {
    while (is_narrow(sections[begin])) ++begin;
    run = run_from(begin);
    begin += run.size();
    while (is_narrow(run.back())) run = run.first(run.size() - 1);
    return run;
  }
  begin += run.size();
  return run;
}

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
  lane.left = MeasuredPolyline(lane.left).points();
  lane.width_m = width_sum_m / static_cast<double>(run.size());
  lane.left_borders = {
      border_of(left, {run.front().left_arc_m, run.back().left_arc_m}, length(lane.centerline))};
  lane.right_borders = {
      border_of(right, {run.front().right_arc_m, run.back().right_arc_m}, length(lane.centerline))};
  std::erase_if(lane.inferred_ranges, [](const Stretch& range) { return range.length() <= 0.0; });
  return lane;
}

}  // namespace laneloom::lanes
