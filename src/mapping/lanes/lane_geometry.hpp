#pragma once

#include <Eigen/Geometry>
#include <compare>
#include <cstddef>
#include <optional>
#include <vector>

#include "laneloom/lane_graph.hpp"
#include "laneloom/polyline.hpp"
#include "laneloom/types.hpp"

/// How a lane lies along its boundaries, and how it leads into another lane.
namespace laneloom::lanes {

/// Bounds everything within `margin_m` of a line, on its level. It serves to exclude quickly what is further
/// away.
using Box = Eigen::AlignedBox3d;
Box box_around(const Polyline& line, double margin_m = 0.0);

/// Number of points of `line` that lie beside `other`, nearer than `max_distance_m` and on its level.
std::size_t points_beside(const Polyline& line, const MeasuredPolyline& other, double max_distance_m);

/// One side of a boundary.
struct BoundarySide {
  ElementId boundary = kNoElement;
  Side side = Side::right;  ///< as the boundary runs

  BoundarySide other() const { return {boundary, opposite(side)}; }
  auto operator<=>(const BoundarySide&) const = default;
};

/// The left or right side of a lane: a stretch of the boundary there.
struct LaneSide {
  BoundarySide of;        ///< the boundary, and the side of it on which the lane lies
  Stretch range;          ///< on the boundary, as it runs itself
  bool reversed = false;  ///< the boundary runs against the lane

  double begin_m() const { return reversed ? range.to_m : range.from_m; }
  double end_m() const { return reversed ? range.from_m : range.to_m; }
};
LaneSide lane_side(const Border& border, Side side);
/// The side of a lane at one of its ends. Its boundary is kNoElement where none was seen there.
LaneSide side_at_end(const Lane& lane, Side side, End end);
/// Whether one lane follows another one between the same two boundaries.
bool is_between_the_same(const Lane& from, const Lane& to);
/// Whether two lanes lie on the two sides of one boundary: the one has it on `side`, the other across.
bool share_boundary(const Lane& lane, Side side, const Lane& across);
/// The mean of a value along the borders that were seen. 0: none was.
template <class Value>
double mean_over(const std::vector<Border>& borders, Value value) {
  double sum = 0.0, length_m = 0.0;
  for (const Border& border : borders) {
    if (border.boundary == kNoElement) continue;
    length_m += border.range.length();
    sum += border.range.length() * value(border);
  }
  return length_m > 0.0 ? sum / length_m : 0.0;
}
/// The side of a lane that has one border there, as the mapper makes them.
LaneSide lane_side(const Lane& lane, Side side);

bool are_neighbours(const Lane& a, const Lane& b);

/// The neighbour on a side that shares the longest stretch. kNoElement: there is none.
ElementId main_neighbour(const Lane& lane, Side side);

/// The sense in which the vehicle drives in the lane. 1: along it; -1: against it; 0: the vehicle is
/// elsewhere or crosses the lane, at 45 degrees or where the cosine of the angle is below `min_cosine`.
double ego_sense(const Lane& lane, const Eigen::Isometry3d& T_map_body, double min_cosine = 0.0);

/// Unit direction in which a lane is left at its end, or entered at its start; map frame, horizontal.
Eigen::Vector2d leaving(const Lane& lane);
Eigen::Vector2d entering(const Lane& lane);

/// The vector from the end of `from` to the start of `to`; map frame, horizontal, in metres.
Eigen::Vector2d gap_between(const Lane& from, const Lane& to);

/// Whether a road may lead from the end of `from` up or down to the start of `to`: by 2 m, or by 12 %.
bool may_climb(const Lane& from, const Lane& to);

/// The turn of a way that is driven from its end to its start.
Linkage::Turn reversed(Linkage::Turn turn);

/// Greatest overlap of a lane with the lane that it continues, in metres.
inline constexpr double kMaxOverlap_m = 2.0;

/// The point where the extensions of two lanes meet: `before_m` ahead of the end of the one, and `after_m`
/// before the start of the other. Negative: the extensions meet within the lane or behind it.
struct Corner {
  double before_m, after_m;
};

/// The corner of a left or right turn from one lane into another. Empty: the turn between them is neither.
std::optional<Corner> corner_between(const Lane& from, const Lane& to);

/// Distance between the vertices of a path, in metres.
inline constexpr double kPathStep_m = 1.0;
/// Two lanes with a shorter gap, in metres, meet: it is no more than the distance between vertices.
inline constexpr double kMinGap_m = 1.0;

/// A path from the end of one lane to the start of another, map frame. Round a corner it is an arc; otherwise
/// it is a cubic that begins and ends in the directions of the lanes.
Polyline path_between(const Lane& from, const Lane& to);

/// As path_between(), but empty where `to` begins no further on than `from` ends: there the lanes meet.
Polyline path_ahead(const Lane& from, const Lane& to);

}  // namespace laneloom::lanes
