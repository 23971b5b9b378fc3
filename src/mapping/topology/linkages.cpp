#include "mapping/topology/linkages.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "laneloom/polyline.hpp"
#include "mapping/geometry/left_of.hpp"
#include "mapping/lanes/lane_geometry.hpp"

namespace laneloom::topology {
namespace {

constexpr double kOnTip_m = 0.5;          // before a tip, where a branch may begin
constexpr double kMaxBranchGap_m = 45.0;  // from a tip to its branch
constexpr double kMaxStemGap_m = 5.0;     // from a tip to the end of its stem
constexpr double kForkProbability = 0.75;
constexpr double kCosCorner = 0.643;  // a corner turns by 50 to 130 degrees

/// The gap from the end of one lane to the start of another, along the boundary that both lie beside. Empty:
/// they share no boundary, or `to` does not follow.
std::optional<double> shared_gap(const lanes::LaneSide& from, const lanes::LaneSide& to, double max_gap_m) {
  if (from.of.boundary == kNoElement || from.of != to.of || from.reversed != to.reversed) return std::nullopt;
  const double sense = from.reversed ? -1.0 : 1.0;
  const double gap_m = sense * (to.begin_m() - from.end_m());
  const bool follows =
      gap_m >= -lanes::kMaxOverlap_m && gap_m <= max_gap_m && sense * (to.begin_m() - from.begin_m()) > 0.0;
  return follows ? std::optional(std::max(gap_m, 0.0)) : std::nullopt;
}

/// The path from the end of `from` to the start of `to`, beside the boundary that they share.
Polyline path_along(const MeasuredPolyline& boundary, const Lane& from, const Lane& to) {
  const Point &start = from.centerline.back(), &end = to.centerline.front();
  const Projection begun = boundary.project(start), continued = boundary.project(end);
  const double length_m = continued.arc_m - begun.arc_m;
  const int steps = static_cast<int>(std::ceil(std::abs(length_m) / lanes::kPathStep_m));
  Polyline path{start};
  for (int i = 1; i < steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    const double arc_m = begun.arc_m + share * length_m;
    const Eigen::Vector2d along = boundary.chord(arc_m - lanes::kPathStep_m, arc_m + lanes::kPathStep_m);
    const double lateral_m = begun.lateral_m + share * (continued.lateral_m - begun.lateral_m);
    path.push_back(geometry::beside(boundary.at(arc_m), along, lateral_m));
  }
  path.push_back(end);
  return path;
}

/// The linkage to the next lane along one side of `from`.
std::optional<Linkage> link_along(const Lane& from, Side side, const lanes::LaneLayout& layout,
                                  const LinkageConfig& config) {
  const lanes::LaneSide begun = lanes::side_at_end(from, side, End::back);
  const Lane* next = nullptr;
  double next_gap_m = std::numeric_limits<double>::infinity();
  for (const Lane& to : layout.lanes) {
    if (to.id == from.id) continue;
    const lanes::LaneSide continued = lanes::side_at_end(to, side, End::front);
    const auto gap_m = shared_gap(begun, continued, config.max_shared_gap_m);
    if (!gap_m || *gap_m >= next_gap_m) continue;
    if (lanes::forks_before(begun, layout.forks) != lanes::forks_before(continued, layout.forks)) continue;
    next = &to;
    next_gap_m = *gap_m;
  }
  if (next == nullptr) return std::nullopt;
  if (leads_elsewhere(from, *next, layout)) return std::nullopt;
  Linkage linkage{.from = from.id,
                  .to = next->id,
                  .kind = Linkage::Kind::shared_boundary,
                  .probability = 1.0 - 0.5 * next_gap_m / config.max_shared_gap_m,
                  .evidence = evidence_between(from, *next),
                  .path = {}};
  if (next_gap_m >= lanes::kMinGap_m)
    linkage.path = path_along(layout.boundaries.of(begun.of.boundary).course, from, *next);
  return linkage;
}

/// The lane whose end on one side of a fork's boundary is nearest to the tip, by `distance_m` of the end's
/// place on the boundary. The lane runs as the branch does. Null: every distance is infinite.
template <class Distance>
const Lane* nearest_to_tip(const lanes::Fork& fork, const lanes::BoundarySide& of, End end,
                           const lanes::LaneLayout& layout, Distance distance_m) {
  const Lane* nearest = nullptr;
  double least_m = std::numeric_limits<double>::infinity();
  for (const Lane& lane : layout.lanes) {
    for (const Side side : kSides) {
      const lanes::LaneSide along = lanes::side_at_end(lane, side, end);
      if (along.of != of || along.reversed != fork.reversed) continue;
      const double its_m = distance_m(end == End::front ? along.begin_m() : along.end_m());
      if (its_m >= least_m) continue;
      nearest = &lane;
      least_m = its_m;
    }
  }
  return nearest;
}

/// A distance that is within limits; else infinity.
double within(double distance_m, double least_m, double most_m) {
  return distance_m >= least_m && distance_m <= most_m ? distance_m : std::numeric_limits<double>::infinity();
}

/// The linkage between the stem and the branch of a fork. Empty: no stem ends there, because it was too short
/// to be cut, or the branch is gone.
std::optional<Linkage> link_at(const lanes::Fork& fork, const lanes::LaneLayout& layout) {
  const bool opens = fork.end == End::front;
  const double sense = opens != fork.reversed ? 1.0 : -1.0;  // from the tip into the branch
  const Lane* branch = nearest_to_tip(fork, fork.branch, fork.end, layout, [&](double arc_m) {
    return within(sense * (arc_m - fork.arc_m), -kOnTip_m, kMaxBranchGap_m);
  });
  const Lane* stem = nearest_to_tip(fork, fork.branch.other(), opposite(fork.end), layout, [&](double arc_m) {
    return within(std::abs(arc_m - fork.arc_m), 0.0, kMaxStemGap_m);
  });
  if (stem == nullptr || branch == nullptr) return std::nullopt;
  const Lane &from = opens ? *stem : *branch, &to = opens ? *branch : *stem;
  return Linkage{.from = from.id,
                 .to = to.id,
                 .kind = Linkage::Kind::shared_boundary,
                 .probability = kForkProbability,
                 .evidence = evidence_between(from, to),
                 .path = lanes::path_ahead(from, to)};
}

/// The probability that `to` continues `from`, by the alignment of their centerlines. Empty: it does not.
std::optional<double> alignment(const Lane& from, const Lane& to, const LinkageConfig& config) {
  const Eigen::Vector2d a = lanes::leaving(from), b = lanes::entering(to), gap = lanes::gap_between(from, to);
  if (a.dot(b) < cos_degrees(config.max_angle_deg)) return std::nullopt;
  const double along_m = gap.dot(a);
  const double lateral_m = std::abs(cross(a, gap));
  if (along_m < -lanes::kMaxOverlap_m || along_m > config.max_gap_m) return std::nullopt;
  if (lateral_m > config.max_lateral_m) return std::nullopt;
  const double misfit = std::max(std::abs(along_m) / config.max_gap_m, lateral_m / config.max_lateral_m);
  return 1.0 - 0.5 * misfit;
}

bool go_round_an_island(const Lane& from, const Lane& to, const lanes::LaneLayout& layout) {
  return std::ranges::any_of(
      kSides, [&](Side side) { return layout.goes_round(from, side) && layout.goes_round(to, side); });
}

}  // namespace

bool leads_elsewhere(const Lane& from, const Lane& to, const lanes::LaneLayout& layout) {
  if (go_round_an_island(from, to, layout) ||
      std::abs(lanes::leaving(from).dot(lanes::entering(to))) > kCosCorner)
    return false;
  const auto is_between_edges = [&](const Lane& lane) {
    return std::ranges::all_of(kSides, [&](Side side) {
      return std::ranges::any_of(lane.borders(side), [&](const Border& border) {
        const boundaries::LaneBoundary* boundary = layout.boundaries.find(border.boundary);
        return boundary != nullptr && boundary->is_edge();
      });
    });
  };
  return (is_between_edges(from) || is_between_edges(to)) && !lanes::is_between_the_same(from, to);
}

RoadGraph link_lanes(lanes::LaneLayout layout, const LinkageConfig& config) {
  RoadGraph road{std::move(layout), {}};
  std::vector<Linkage>& linkages = road.linkages;
  for (const Lane& from : road.lanes) {
    for (const Side side : kSides)
      if (auto linkage = link_along(from, side, road, config)) linkages.push_back(std::move(*linkage));
    for (const Lane& to : road.lanes) {
      if (to.id == from.id) continue;
      const auto probability = alignment(from, to, config);
      if (!probability) continue;
      linkages.push_back({.from = from.id,
                          .to = to.id,
                          .kind = Linkage::Kind::geometric_alignment,
                          .probability = *probability,
                          .evidence = evidence_between(from, to),
                          .path = lanes::path_ahead(from, to)});
    }
  }
  for (const lanes::Fork& fork : road.forks)
    if (auto linkage = link_at(fork, road)) linkages.push_back(std::move(*linkage));
  road.sort_linkages();
  const auto same = [](const Linkage& a, const Linkage& b) { return a.from == b.from && a.to == b.to; };
  linkages.erase(std::unique(linkages.begin(), linkages.end(), same), linkages.end());
  return road;
}

}  // namespace laneloom::topology
