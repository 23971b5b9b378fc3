#include "mapping/lanes/lanes.hpp"

#include <algorithm>
#include <array>

#include "laneloom/polyline.hpp"
#include "mapping/lanes/cross_sections.hpp"
#include "mapping/lanes/gores.hpp"
#include "mapping/lanes/lane_geometry.hpp"
#include "mapping/markings/markings.hpp"

namespace laneloom {
namespace {

constexpr double kDashedWidening = 1.15;       // of the widest lane
constexpr double kEdgesWidening = 1.25;        // of the narrowest
constexpr double kMinKerbLaneLength_m = 10.0;  // a shorter widening is where a road splits or ends

/// How wide a lane between two boundaries may be. Between edges it needs room to either. Between dashes in a
/// bend it is wider than elsewhere; what is so wide between solid lines rather is a median.
LaneConfig limits_between(const Marking& left, const Marking& right, LaneConfig config) {
  const auto is_dashed = [](const Marking& marking) {
    return marking.type == MarkingType::laneline &&
           dashed_excess_m(marking, {0.0, length(marking.points)}) > 0.0;
  };
  if (is_dashed(left) && is_dashed(right)) config.max_width_m *= kDashedWidening;
  if (left.type == MarkingType::roadedge && right.type == MarkingType::roadedge)
    config.min_width_m *= kEdgesWidening;
  return config;
}

Occupied joined(Occupied a, const Occupied& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace

std::vector<Lane> generate_lanes(const std::vector<BoundaryPair>& pairs,
                                 const std::vector<LaneBoundary>& boundaries,
                                 const std::vector<MeasuredPolyline>& measured, const Point& vehicle,
                                 const LaneConfig& config) {
  std::vector<Lane> lanes;
  // Per boundary: its right side, its left side.
  std::vector<std::array<Occupied, 2>> used(boundaries.size());
  const auto is_edge = [&](std::size_t i) { return boundaries[i].marking.type == MarkingType::roadedge; };
  const auto pair_lanes = [&](const BoundaryPair& pair, const Occupied& left_used,
                              const Occupied& right_used) {
    const LaneBorder left(boundaries[pair.left], measured[pair.left], pair.left_reversed, left_used);
    const LaneBorder right(boundaries[pair.right], measured[pair.right], pair.right_reversed, right_used);
    // Between two edges so far apart, there rather is a verge.
    const bool kerb = pair.adjacent && pair.left_kerb != pair.right_kerb;
    const LaneConfig limits = limits_between(left.marking(), right.marking(), config);
    auto sections =
        cross_sections(left, right, 0.0, kerb ? limits.max_kerb_width_m : limits.max_width_m, limits);
    remove_gores(left, right, vehicle, sections);
    for (CrossSection& section : sections) {
      if (section.width_m < limits.min_width_m) section.valid = false;
      if (section.wide && find_between(section, pair, boundaries, measured)) section.valid = false;
    }
    for (std::size_t begin = 0; begin < sections.size();) {
      const auto run = next_run(sections, begin, config);
      const double min_length_m = run.front().wide ? kMinKerbLaneLength_m : config.min_length_m;
      if (length_of(run) >= min_length_m) {
        lanes.push_back(make_lane(run, left, right));
        lanes.back().section = pair.section;
        used[pair.left][pair.left_reversed].push_back(lanes.back().left_range);
        used[pair.right][!pair.right_reversed].push_back(lanes.back().right_range);
      }
    }
  };
  std::vector<BoundaryPair> between_edges;
  for (const BoundaryPair& pair : pairs) {
    if (!pair.near) continue;
    if (is_edge(pair.left) && is_edge(pair.right)) {
      between_edges.push_back(pair);
    } else {
      pair_lanes(pair, used[pair.left][pair.left_reversed], used[pair.right][!pair.right_reversed]);
    }
  }
  // What lies beyond the edge of a road with lanes is a verge, a pavement or a cycle track.
  const auto roads = used;
  for (const BoundaryPair& pair : between_edges) {
    pair_lanes(pair, joined(used[pair.left][pair.left_reversed], roads[pair.left][!pair.left_reversed]),
               joined(used[pair.right][!pair.right_reversed], roads[pair.right][pair.right_reversed]));
  }
  return lanes;
}

}  // namespace laneloom
