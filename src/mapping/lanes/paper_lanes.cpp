#include "mapping/lanes/paper_lanes.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "mapping/boundaries/boundary_pairs.hpp"
#include "mapping/geometry/stretches.hpp"
#include "mapping/lanes/cross_sections.hpp"

namespace laneloom::lanes {
namespace {

/// Stretches of one side of a boundary that belong to lanes.
using Occupied = std::vector<Stretch>;

/// The next run of cross-sections from `begin` on; `begin` is moved behind it. In a run the width varies by
/// no more than `max_variation_m`, and the left boundary is followed forwards.
std::span<const CrossSection> next_run(const std::vector<CrossSection>& sections, std::size_t& begin,
                                       double max_variation_m) {
  double narrowest_m = std::numeric_limits<double>::infinity(), widest_m = 0.0;
  const std::size_t first = begin;
  for (; begin < sections.size() && sections[begin].valid; ++begin) {
    if (begin > first && sections[begin].left_arc_m < sections[begin - 1].left_arc_m) break;
    narrowest_m = std::min(narrowest_m, sections[begin].width_m);
    widest_m = std::max(widest_m, sections[begin].width_m);
    if (widest_m - narrowest_m > max_variation_m) break;
  }
  begin = std::max(begin, first + 1);
  return std::span(sections).subspan(first, begin - first);
}

/// Finds the lanes of one pair of boundaries after the other.
class PaperLanes {
 public:
  PaperLanes(const boundaries::Boundaries& boundaries, const LaneConfig& config)
      : boundaries_(boundaries), config_(config), used_(boundaries.size()) {}

  void add(const boundaries::BoundaryPair& pair) {
    const LaneBorder left(boundaries_[pair.left], pair.left_reversed);
    const LaneBorder right(boundaries_[pair.right], pair.right_reversed);
    Occupied &left_used = used(pair, Side::left), &right_used = used(pair, Side::right);
    const std::vector<CrossSection> sections = sections_between(left, left_used, right, right_used);
    for (std::size_t begin = 0; begin < sections.size();) {
      const auto run = next_run(sections, begin, config_.max_width_variation_m);
      if (!run.front().valid || length_of(run) < config_.min_length_m) continue;
      Lane lane = make_lane(run, left, right);
      lane.section = pair.section;
      left_used.push_back(lane.left_borders.front().on_boundary);
      right_used.push_back(lane.right_borders.front().on_boundary);
      lanes_.push_back(std::move(lane));
    }
  }

  std::vector<Lane> take() { return std::move(lanes_); }

 private:
  /// The stretches of a pair's boundary that belong to lanes on the pair's side of it.
  Occupied& used(const boundaries::BoundaryPair& pair, Side border) {
    return used_[pair.index(border)][index(pair.inner(border))];
  }

  /// Cross-sections along the right border. They are valid where both borders are free and their distance
  /// lies within the limits.
  std::vector<CrossSection> sections_between(const LaneBorder& left, const Occupied& left_used,
                                             const LaneBorder& right, const Occupied& right_used) const {
    const Polyline points = right.line().resample(config_.step_m);
    std::vector<CrossSection> sections(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double arc_m =
          right.line().length() * static_cast<double>(i) / static_cast<double>(points.size() - 1);
      const Projection foot = left.line().project(points[i], config_.max_width_m);
      if (!foot.inside || foot.distance_m < config_.min_width_m || foot.lateral_m >= 0.0) continue;
      if (geometry::contains(right_used, right.own(arc_m)) ||
          geometry::contains(left_used, left.own(foot.arc_m)))
        continue;
      sections[i] = {.left_arc_m = foot.arc_m,
                     .right_arc_m = arc_m,
                     .width_m = foot.distance_m,
                     .left = foot.foot,
                     .right = points[i],
                     .valid = true};
    }
    return sections;
  }

  const boundaries::Boundaries& boundaries_;
  const LaneConfig& config_;
  std::vector<std::array<Occupied, 2>> used_;  ///< by boundary and side
  std::vector<Lane> lanes_;
};

}  // namespace

FoundLanes paper_lanes(boundaries::SectionGraph road, const LaneConfig& config) {
  PaperLanes lanes(road.boundaries, config);
  for (const boundaries::BoundaryPair& pair : boundary_pairs(road)) lanes.add(pair);
  return {std::move(road.boundaries), lanes.take(), {}};
}

}  // namespace laneloom::lanes
