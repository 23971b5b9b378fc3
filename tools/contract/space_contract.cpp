#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "contract/findings.hpp"

namespace laneloom::contract {
namespace {

constexpr double kSigmas = 3.0;
constexpr double kOverlapTolerance_m = 0.1;
constexpr double kStep_m = 2.0;
constexpr double kJoint_m =
    2.0;  // along the lane, up to which one lane may begin before the one behind it ends
constexpr double kLevel_m = 2.0;  // lanes further above one another belong to two roads

using BoundariesById = std::map<ElementId, const Marking*>;

/// A lane that others are compared with.
struct Strip {
  const Lane* lane;
  MeasuredPolyline left, right, centerline;
  Eigen::AlignedBox3d box;
};

Eigen::AlignedBox3d box_of(const Lane& lane) {
  Eigen::AlignedBox3d box;
  for (const Polyline* line : {&lane.left, &lane.right})
    for (const Point& point : *line) box.extend(point);
  return box;
}

/// The lateral deviation of a lane's side near a place. Empty: it is not known.
std::optional<double> stddev_m(const Strip& strip, Side side, const Point& place,
                               const BoundariesById& boundaries) {
  const Border* border = strip.lane->border_at(side, strip.centerline.project(place).arc_m);
  const auto found = border == nullptr ? boundaries.end() : boundaries.find(border->boundary);
  if (found == boundaries.end()) return std::nullopt;
  const Marking& boundary = *found->second;
  if (boundary.lateral_stddev_m.empty() || boundary.lateral_stddev_m.size() != boundary.points.size())
    return std::nullopt;
  const auto nearest = std::ranges::min_element(
      boundary.points, {}, [&](const Point& point) { return (point - place).squaredNorm(); });
  return boundary.lateral_stddev_m[static_cast<std::size_t>(nearest - boundary.points.begin())];
}

/// Whether a place lies beside an end of a strip, where another lane goes on.
bool is_at_end(const Strip& strip, const Point& place) {
  const double arc_m = strip.centerline.project(place).arc_m;
  return arc_m < kJoint_m || arc_m > strip.centerline.length() - kJoint_m;
}

/// A side of a strip, and how far inside of it a place lies.
struct Depth {
  Side side;
  double depth_m;
};

/// The nearer side of a strip that a place lies within. Empty: it lies beside the strip.
std::optional<Depth> depth_in(const Strip& strip, const Point& place) {
  const Projection left = strip.left.project(place), right = strip.right.project(place);
  const bool within = left.inside && right.inside && left.lateral_m < 0.0 && right.lateral_m > 0.0 &&
                      std::abs(left.foot.z() - place.z()) < kLevel_m;
  if (!within) return std::nullopt;
  return left.distance_m < right.distance_m ? Depth{Side::left, left.distance_m}
                                            : Depth{Side::right, right.distance_m};
}

/// By how much the sides of one lane lie too far inside of another.
double overlap_m(const Strip& one, const Strip& other, const BoundariesById& boundaries) {
  double overlap_m = 0.0;
  for (const Side side : kSides) {
    for (const Point& place : (side == Side::left ? one.left : one.right).resample(kStep_m)) {
      if (!other.box.contains(place) || (is_at_end(one, place) && is_at_end(other, place))) continue;
      const auto depth = depth_in(other, place);
      if (!depth || depth->depth_m <= kOverlapTolerance_m + overlap_m) continue;
      const auto own_m = stddev_m(one, side, place, boundaries);
      const auto its_m = stddev_m(other, depth->side, place, boundaries);
      if (own_m && its_m)
        overlap_m =
            std::max(overlap_m, depth->depth_m - kOverlapTolerance_m - kSigmas * std::hypot(*own_m, *its_m));
    }
  }
  return overlap_m;
}

}  // namespace

void check_space(const LocalMap& map, Findings& findings) {
  BoundariesById boundaries;
  for (const Marking& boundary : map.boundaries) boundaries.emplace(boundary.id, &boundary);
  std::vector<Strip> strips;
  for (const Lane& lane : map.lanes)
    if (lane.use == Lane::Use::lane && is_measurable(lane.left) && is_measurable(lane.right) &&
        is_measurable(lane.centerline))
      strips.push_back({&lane, MeasuredPolyline(lane.left), MeasuredPolyline(lane.right),
                        MeasuredPolyline(lane.centerline), box_of(lane)});
  for (const Strip& one : strips) {
    for (const Strip& other : strips) {
      if (&one == &other || !one.box.intersects(other.box)) continue;
      const double too_far_m = overlap_m(one, other, boundaries);
      findings.require(
          too_far_m <= 0.0, ContractRule::lanes_apart,
          label(*one.lane) + " lies " + std::to_string(too_far_m) + " m too far in " + label(*other.lane));
    }
  }
}

}  // namespace laneloom::contract
