#include "mapping/linkages.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

#include "laneloom/polyline.hpp"
#include "mapping/lane_geometry.hpp"

namespace laneloom {
namespace {

constexpr double kMinGap_m = 1.0;  // a shorter one is no more than the distance between vertices
constexpr double kPathStep_m = 1.0;

/// The courses of boundaries by their ids.
class Boundaries {
 public:
  Boundaries(const std::vector<LaneBoundary>& boundaries, const std::vector<MeasuredPolyline>& measured)
      : boundaries_(boundaries), measured_(measured) {}
  const MeasuredPolyline& at(ElementId id) const {
    const auto found = std::ranges::lower_bound(boundaries_, id, {}, id_of);
    return measured_[static_cast<std::size_t>(found - boundaries_.begin())];
  }

 private:
  static ElementId id_of(const LaneBoundary& boundary) { return boundary.marking.id; }
  const std::vector<LaneBoundary>& boundaries_;
  const std::vector<MeasuredPolyline>& measured_;
};

/// One side of a lane.
struct Side {
  ElementId boundary = kNoElement;
  Range range;
};
Side left_side(const Lane& lane) { return {lane.left_boundary, lane.left_range}; }
Side right_side(const Lane& lane) { return {lane.right_boundary, lane.right_range}; }

/// From the end of one lane to the start of another along their shared boundary; empty where they share none
/// or `to` does not follow.
std::optional<double> shared_gap(const Side& from, const Side& to, double max_gap_m) {
  const double gap_m = to.range.from_m - from.range.to_m;
  const bool follows = gap_m >= -kMaxOverlap_m && gap_m <= max_gap_m && to.range.from_m > from.range.from_m;
  if (from.boundary != to.boundary || !follows) return std::nullopt;
  return std::max(gap_m, 0.0);
}

/// From the end of `from` to the start of `to`, beside the boundary that they share; empty where they meet.
Polyline path_along(const MeasuredPolyline& boundary, const Range& gap, const Lane& from, const Lane& to) {
  if (gap.length() < kMinGap_m) return {};
  const Point &start = from.centerline.back(), &end = to.centerline.front();
  const double start_m = boundary.project(start).lateral_m, end_m = boundary.project(end).lateral_m;
  const int steps = static_cast<int>(std::ceil(gap.length() / kPathStep_m));
  Polyline path{start};
  for (int i = 1; i < steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    const double arc_m = gap.from_m + share * gap.length();
    const Eigen::Vector2d along =
        (boundary.at(arc_m + kPathStep_m) - boundary.at(arc_m - kPathStep_m)).head<2>().normalized();
    const double lateral_m = start_m + share * (end_m - start_m);
    path.push_back(boundary.at(arc_m) + lateral_m * Point(-along.y(), along.x(), 0.0));
  }
  path.push_back(end);
  return path;
}

/// The lane that comes next along one side of `from`.
template <class SideOf>
void link_along(const Lane& from, const std::vector<Lane>& lanes, const Boundaries& boundaries,
                const LinkageConfig& config, SideOf side_of, std::vector<Linkage>& linkages) {
  const Lane* next = nullptr;
  double next_gap_m = std::numeric_limits<double>::infinity();
  for (const Lane& to : lanes) {
    if (to.id == from.id) continue;
    const auto gap_m = shared_gap(side_of(from), side_of(to), config.max_shared_gap_m);
    if (!gap_m || *gap_m >= next_gap_m) continue;
    next = &to;
    next_gap_m = *gap_m;
  }
  if (next == nullptr) return;
  const Side side = side_of(from);
  linkages.push_back({.from = from.id,
                      .to = next->id,
                      .kind = Linkage::Kind::shared_boundary,
                      .confidence = 1.0 - 0.5 * next_gap_m / config.max_shared_gap_m,
                      .path = path_along(boundaries.at(side.boundary),
                                         {side.range.to_m, side_of(*next).range.from_m}, from, *next)});
}

/// Between aligned lanes; empty where they meet.
Polyline path_across(const Lane& from, const Lane& to) {
  if (gap_between(from, to).dot(leaving(from)) < kMinGap_m) return {};
  return path_between(from, to);
}

/// Confidence that `to` continues `from` by the geometry of their centerlines; empty: it does not.
std::optional<double> alignment(const Lane& from, const Lane& to, const LinkageConfig& config) {
  const Eigen::Vector2d a = leaving(from), b = entering(to), gap = gap_between(from, to);
  if (a.dot(b) < cos_degrees(config.max_angle_deg)) return std::nullopt;
  const double along_m = gap.dot(a);
  const double lateral_m = std::abs(cross(a, gap));
  if (along_m < -kMaxOverlap_m || along_m > config.max_gap_m) return std::nullopt;
  if (lateral_m > config.max_lateral_m) return std::nullopt;
  const double misfit = std::max(std::abs(along_m) / config.max_gap_m, lateral_m / config.max_lateral_m);
  return 1.0 - 0.5 * misfit;
}

}  // namespace

std::vector<Linkage> generate_linkages(const std::vector<Lane>& lanes,
                                       const std::vector<LaneBoundary>& boundaries,
                                       const std::vector<MeasuredPolyline>& measured,
                                       const LinkageConfig& config) {
  const Boundaries by_id(boundaries, measured);
  std::vector<Linkage> linkages;
  for (const Lane& from : lanes) {
    link_along(from, lanes, by_id, config, left_side, linkages);
    link_along(from, lanes, by_id, config, right_side, linkages);
    for (const Lane& to : lanes) {
      if (to.id == from.id) continue;
      const auto confidence = alignment(from, to, config);
      if (!confidence) continue;
      linkages.push_back({.from = from.id,
                          .to = to.id,
                          .kind = Linkage::Kind::geometric_alignment,
                          .confidence = *confidence,
                          .path = path_across(from, to)});
    }
  }
  std::ranges::stable_sort(linkages, {}, [](const Linkage& l) { return std::tuple(l.from, l.to, l.kind); });
  const auto same = [](const Linkage& a, const Linkage& b) { return a.from == b.from && a.to == b.to; };
  linkages.erase(std::unique(linkages.begin(), linkages.end(), same), linkages.end());
  return linkages;
}

}  // namespace laneloom
