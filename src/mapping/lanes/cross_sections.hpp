#pragma once

#include <span>

#include "laneloom/polyline.hpp"
#include "laneloom/types.hpp"
#include "mapping/boundaries/lane_boundaries.hpp"

/// Cross-sections of the space between two boundaries, and the lanes that are made of them.
namespace laneloom::lanes {

/// A boundary, seen in the direction in which a lane beside it runs. It refers to the constructor's argument.
class LaneBorder {
 public:
  LaneBorder(const boundaries::LaneBoundary& boundary, bool reversed);
  const MeasuredPolyline& line() const { return reversed_ ? turned_ : boundary_.course; }
  const Marking& marking() const { return boundary_.marking; }
  bool reversed() const { return reversed_; }
  bool is_bridged(double arc_m) const;
  /// The same place or stretch, on the boundary as it runs itself.
  double own(double arc_m) const { return reversed_ ? boundary_.course.length() - arc_m : arc_m; }
  Stretch own(const Stretch& range) const {
    return reversed_ ? Stretch{own(range.to_m), own(range.from_m)} : range;
  }

 private:
  const boundaries::LaneBoundary& boundary_;
  bool reversed_;
  MeasuredPolyline turned_;
};

/// A place on the right border of a lane with its place on the left one.
struct CrossSection {
  double left_arc_m = 0.0;      ///< on the left border, as the lane runs
  double right_arc_m = 0.0;     ///< on the right border, as the lane runs
  double width_m = 0.0;         ///< distance of the two points
  Point left = Point::Zero();   ///< map frame
  Point right = Point::Zero();  ///< map frame
  bool valid = false;           ///< the section may be part of a lane

  Point middle() const { return 0.5 * (left + right); }
};

/// Length of a run of cross-sections along the left border.
inline double length_of(std::span<const CrossSection> run) {
  return run.back().left_arc_m - run.front().left_arc_m;
}

/// The lane of a run.
Lane make_lane(std::span<const CrossSection> run, const LaneBorder& left, const LaneBorder& right);

}  // namespace laneloom::lanes
