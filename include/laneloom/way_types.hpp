#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "laneloom/elements.hpp"

/// The way: one smooth line ahead of the vehicle, along the lanes of a map, for a planner to drive on. A map
/// carries its own way; way_ahead() of way.hpp makes others. Everything here is pure, and may be used by
/// several threads at once. Coordinates are of the map frame, in metres.
namespace laneloom {

/// Where a planner wishes to go.
enum class WayWish : std::uint8_t {
  straight,      ///< straight on wherever lanes fork
  left,          ///< to the left at the next place that allows it, and straight on from there
  right,         ///< likewise to the right
  change_left,   ///< into the lane on the left, as soon as that is allowed; once, however long it is wished
  change_right,  ///< likewise on the right
};

/// A measure that is not known, in place of a length. Lengths are 0 or more.
inline constexpr double kNotKnown_m = -1.0;

/// The way at one arc length.
struct WayStation {
  Point point = Point::Zero();
  double heading_rad = 0.0;      ///< from the x axis to the left
  double curvature_per_m = 0.0;  ///< positive: to the left
  ElementId lane = kNoElement;   ///< kNoElement: on a passage between two lanes
  double left_m = kNotKnown_m;   ///< to the lane's left border; not known on a passage
  double right_m = kNotKnown_m;  ///< to the lane's right border; likewise
  double width_m = kNotKnown_m;  ///< of the lane; not known unless both borders are
  /// Lateral standard deviation of the middle of the lane, by those of its boundaries, or of a driven path.
  /// Along a street of the SD map it grows from station to station. Not known where a boundary has none, and
  /// on other passages.
  double lateral_stddev_m = kNotKnown_m;
  /// Inferred within the lane's inferred ranges, and on a passage with a path: nobody saw a lane there.
  ElementStatus status = ElementStatus::confirmed;
  bool may_change_left = false;   ///< the line may be crossed, into a lane that is not known to be oncoming
  bool may_change_right = false;  ///< likewise

  /// The heading as a horizontal vector of unit length.
  Eigen::Vector2d direction() const;
};

/// A lane that the way goes through.
struct WayLane {
  ElementId id = kNoElement;
  bool against = false;                          ///< it is walked against the order of its points
  Linkage::Turn entry = Linkage::Turn::unknown;  ///< the turn into it; unknown: the way begins in it
  Stretch range;                                 ///< on the way
};

/// A change from one lane to the one beside it.
struct LaneChange {
  ElementId from = kNoElement;  ///< kNoElement: there is no change
  ElementId to = kNoElement;
  Point begin = Point::Zero();  ///< in the middle of the lane that is left
  double length_m = 0.0;        ///< along the way
};

/// Coordinates along and across a way. Beyond its ends they are those of its tangents.
struct WayPlace {
  double s_m = 0.0;  ///< along the way from its beginning
  double d_m = 0.0;  ///< to the left of the way
};

/// A line to drive on. It begins beside the vehicle, in the middle of its lane.
struct Way {
  WayWish wish = WayWish::straight;
  double step_m = 1.0;               ///< arc length between stations
  std::vector<WayStation> stations;  ///< two or more
  std::vector<WayLane> lanes;        ///< in the order in which they are gone through
  double known_m = 0.0;              ///< length that the map knows, or up to 1 m less; at most the reach
  double confirmed_m = 0.0;          ///< length until the first station that is not confirmed
  LaneChange change;                 ///< begun, or done, for this wish; else without lanes

  /// Whether there are two stations or more, and a step. All else that is asked of a way needs this.
  bool is_line() const { return stations.size() >= 2 && step_m > 0.0; }
  /// Arc length of the last station.
  double length() const { return step_m * static_cast<double>(stations.size() - 1); }
  /// The place of a point. Of several, it is the one beside the nearest station.
  WayPlace to_way(const Point& point) const;
  /// The point of a place, at the way's height. Undoes to_way() as long as `d_m` is less than the radius of
  /// the bend.
  Point to_map(const WayPlace& place) const;
};

}  // namespace laneloom
