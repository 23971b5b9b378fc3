#include "mapping/lanes/lanes.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "laneloom/polyline.hpp"
#include "mapping/lanes/cross_sections.hpp"
#include "mapping/lanes/gores.hpp"
#include "mapping/lanes/lane_geometry.hpp"
#include "mapping/markings/markings.hpp"

namespace laneloom::lanes {
namespace {

constexpr double kDashedWidening = 1.15;       // factor on the width of the widest lane
constexpr double kEdgesWidening = 1.25;        // factor on the width of the narrowest lane
constexpr double kMinKerbLaneLength_m = 10.0;  // a shorter widening is where a road splits or ends

/// The limits for the width of a lane between two boundaries. Between edges a lane needs room to either.
/// Between dashes it may be wider, as lanes widen in bends; a strip of that width between solid lines rather
/// is a median.
LaneConfig limits_between(const Marking& left, const Marking& right, LaneConfig config) {
  const auto is_dashed = [](const Marking& marking) {
    return marking.type == MarkingType::laneline &&
           markings::dashed_excess_m(marking, {0.0, length(marking.points)}) > 0.0;
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

/// Per boundary, the stretches of its sides that belong to lanes.
class UsedSides {
 public:
  explicit UsedSides(std::size_t boundaries) : used_(boundaries) {}
  /// Stretches on the inner side of one boundary of a pair.
  Occupied& within(const boundaries::BoundaryPair& pair, Side border) {
    return used_[pair.index(border)][index(pair.inner(border))];
  }
  /// Stretches on the outer side of one boundary of a pair.
  const Occupied& beyond(const boundaries::BoundaryPair& pair, Side border) const {
    return used_[pair.index(border)][index(opposite(pair.inner(border)))];
  }

 private:
  std::vector<std::array<Occupied, 2>> used_;
};

/// Finds the lanes of one pair of boundaries after the other.
class LaneFinder {
 public:
  LaneFinder(const boundaries::Boundaries& boundaries, const Point& vehicle, const LaneConfig& config)
      : boundaries_(boundaries), vehicle_(vehicle), config_(config), used_(boundaries.size()) {}

  void add(const boundaries::BoundaryPair& pair) {
    add(pair, used_.within(pair, Side::left), used_.within(pair, Side::right));
  }

  /// Adds lanes between two edges, but not where lanes lie on the other side of one of them: beyond the edge
  /// of a road with lanes lies a verge, a pavement or a cycle track.
  void add_between_edges(const std::vector<boundaries::BoundaryPair>& pairs) {
    const UsedSides roads = used_;
    for (const boundaries::BoundaryPair& pair : pairs)
      add(pair, joined(used_.within(pair, Side::left), roads.beyond(pair, Side::left)),
          joined(used_.within(pair, Side::right), roads.beyond(pair, Side::right)));
  }

  std::vector<Lane> take() { return std::move(lanes_); }

 private:
  void add(const boundaries::BoundaryPair& pair, const Occupied& left_used, const Occupied& right_used) {
    const LaneBorder left(boundaries_[pair.left], pair.left_reversed, left_used);
    const LaneBorder right(boundaries_[pair.right], pair.right_reversed, right_used);
    const std::vector<CrossSection> sections = sections_between(pair, left, right);
    for (std::size_t begin = 0; begin < sections.size();) {
      const auto run = next_run(sections, begin, config_.max_width_variation_m);
      if (length_of(run) < (run.front().wide ? kMinKerbLaneLength_m : config_.min_length_m)) continue;
      Lane lane = make_lane(run, left, right);
      lane.section = pair.section;
      used_.within(pair, Side::left).push_back(lane.left_borders.front().on_boundary);
      used_.within(pair, Side::right).push_back(lane.right_borders.front().on_boundary);
      lanes_.push_back(std::move(lane));
    }
  }

  std::vector<CrossSection> sections_between(const boundaries::BoundaryPair& pair, const LaneBorder& left,
                                             const LaneBorder& right) const {
    // Between two kerbs that are as far apart, there rather is a verge.
    const bool kerb = pair.adjacent && pair.left_kerb != pair.right_kerb;
    const LaneConfig limits = limits_between(left.marking(), right.marking(), config_);
    const double max_width_m = kerb ? limits.max_kerb_width_m : limits.max_width_m;
    auto sections = cross_sections(left, right, {.max_m = max_width_m}, limits);
    remove_gores(left, right, vehicle_, sections);
    for (CrossSection& section : sections) {
      if (section.width_m < limits.min_width_m) section.valid = false;
      if (section.wide && find_between(section, pair, boundaries_)) section.valid = false;
    }
    return sections;
  }

  const boundaries::Boundaries& boundaries_;
  const Point& vehicle_;
  const LaneConfig& config_;
  UsedSides used_;
  std::vector<Lane> lanes_;
};

}  // namespace

std::vector<Lane> generate_lanes(const std::vector<boundaries::BoundaryPair>& pairs,
                                 const boundaries::Boundaries& boundaries, const Point& vehicle,
                                 const LaneConfig& config) {
  LaneFinder finder(boundaries, vehicle, config);
  std::vector<boundaries::BoundaryPair> between_edges;
  for (const boundaries::BoundaryPair& pair : pairs) {
    if (!pair.near) continue;
    if (boundaries[pair.left].is_edge() && boundaries[pair.right].is_edge()) {
      between_edges.push_back(pair);
    } else {
      finder.add(pair);
    }
  }
  finder.add_between_edges(between_edges);
  return finder.take();
}

}  // namespace laneloom::lanes
