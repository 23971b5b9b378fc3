#pragma once

#include <Eigen/Core>
#include <compare>
#include <cstddef>
#include <optional>
#include <vector>

#include "laneloom/lane_graph.hpp"
#include "laneloom/polyline.hpp"
#include "laneloom/types.hpp"

/// How a lane lies to its boundaries, and to another that it leads into.
namespace laneloom {

/// How many points of `line` lie nearer than `max_distance_m` beside `other`, on its level.
std::size_t points_beside(const Polyline& line, const MeasuredPolyline& other, double max_distance_m);

/// One side of a boundary.
struct BoundarySide {
  ElementId boundary = kNoElement;
  Side side = Side::right;  ///< as the boundary runs

  BoundarySide other() const { return {boundary, opposite(side)}; }
  auto operator<=>(const BoundarySide&) const = default;
};

/// The left or the right side of a lane, along the boundary there.
struct LaneSide {
  BoundarySide of;  ///< where the lane lies
  Stretch range;
  bool reversed = false;  ///< the boundary runs against the lane

  double begin_m() const { return reversed ? range.to_m : range.from_m; }
  double end_m() const { return reversed ? range.from_m : range.to_m; }
};
LaneSide lane_side(const Lane& lane, Side side);

/// The lane that lies the longest along the same stretch of the boundary, on its other side; null: there is
/// none.
const Lane* lane_across(const LaneSide& side, const std::vector<Lane>& lanes);

bool are_neighbours(const Lane& a, const Lane& b);

/// The neighbour of the longest stretch on a side; kNoElement: there is none.
ElementId main_neighbour(const Lane& lane, Side side);

/// 1: the vehicle drives along the lane, -1: against it, 0: it is elsewhere or crosses it.
double ego_sense(const Lane& lane, const Eigen::Isometry3d& T_map_body);

/// Unit direction in which a lane is left at its end, or entered at its start; map frame, horizontal.
Eigen::Vector2d leaving(const Lane& lane);
Eigen::Vector2d entering(const Lane& lane);

/// From the end of `from` to the start of `to`; map frame, horizontal, in metres.
Eigen::Vector2d gap_between(const Lane& from, const Lane& to);

/// By which a lane may begin before the end of the one that it continues, in metres.
inline constexpr double kMaxOverlap_m = 2.0;

/// Where the extensions of two lanes meet: so far ahead of the one and before the other, in metres.
struct Corner {
  double before_m, after_m;
};

/// Empty where the lanes do not turn.
std::optional<Corner> corner_between(const Lane& from, const Lane& to);

/// Between vertices of a path, in metres.
inline constexpr double kPathStep_m = 1.0;
/// A shorter gap, in metres, is no more than the distance between vertices: the ends meet.
inline constexpr double kMinGap_m = 1.0;

/// From the end of one lane to the start of another: straight on a cubic that leaves and enters in their
/// directions, round a corner on an arc.
Polyline path_between(const Lane& from, const Lane& to);

/// The same straight on, empty where `to` begins no further on than `from` ends: the lanes meet.
Polyline path_ahead(const Lane& from, const Lane& to);

}  // namespace laneloom
