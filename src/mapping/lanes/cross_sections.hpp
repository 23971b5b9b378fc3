#pragma once

#include <optional>
#include <span>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/polyline.hpp"
#include "laneloom/types.hpp"
#include "mapping/boundaries/boundary_pairs.hpp"

/// Cross-sections of the space between two boundaries, and the lanes that are made of them.
namespace laneloom::lanes {

/// Stretches of one side of a boundary that belong to a lane already.
using Occupied = std::vector<Stretch>;

/// A boundary, seen in the direction in which a lane beside it runs. It refers to the constructor's
/// arguments.
class LaneBorder {
 public:
  LaneBorder(const boundaries::LaneBoundary& boundary, bool reversed, const Occupied& occupied);
  const MeasuredPolyline& line() const { return reversed_ ? turned_ : boundary_.course; }
  const Marking& marking() const { return boundary_.marking; }
  bool reversed() const { return reversed_; }
  bool is_free(double arc_m) const;
  bool is_bridged(double arc_m) const;
  /// The same stretch, on the boundary as it runs itself.
  Stretch own(const Stretch& range) const {
    return reversed_ ? Stretch{own(range.to_m), own(range.from_m)} : range;
  }

 private:
  double own(double arc_m) const { return reversed_ ? boundary_.course.length() - arc_m : arc_m; }

  const boundaries::LaneBoundary& boundary_;
  bool reversed_;
  MeasuredPolyline turned_;
  const Occupied& occupied_;
};

/// A sample on the right boundary with its foot on the left one.
struct CrossSection {
  double left_arc_m = 0.0;      ///< on the left border, as the lane runs
  double right_arc_m = 0.0;     ///< on the right border, as the lane runs
  double width_m = 0.0;         ///< distance of the two points
  bool wide = false;            ///< wider than LaneConfig::max_width_m
  Point left = Point::Zero();   ///< map frame
  Point right = Point::Zero();  ///< map frame
  bool valid = false;           ///< the section may be part of a lane

  Point middle() const { return 0.5 * (left + right); }
};

/// A boundary that lies between two others.
struct Between {
  bool is_edge = false;  ///< else it is a line
  double share = 0.0;    ///< its distance from the left boundary, as a share of the width
};

/// Finds an edge, confirmed or not, or else a confirmed line, that lies between the boundaries of a pair. It
/// is not close beside either of them; a line must run along them. Empty: there is none.
std::optional<Between> find_between(const CrossSection& section, const boundaries::BoundaryPair& pair,
                                    const boundaries::Boundaries& boundaries);

/// The narrowest and the widest lane that is looked for.
struct WidthLimits {
  double min_m = 0.0, max_m = 0.0;
};

/// Cross-sections along the right border. They are valid where both borders are free and their distance lies
/// within the limits.
std::vector<CrossSection> cross_sections(const LaneBorder& left, const LaneBorder& right,
                                         const WidthLimits& limits, const LaneConfig& config);

/// The next run of cross-sections from `begin` on; `begin` is moved behind it. In a run the width varies by
/// no more than `max_variation_m`, and the left boundary is followed forwards. Narrow ends of a run that is
/// wider elsewhere are left out: there a lane opens or closes beside another.
std::span<const CrossSection> next_run(const std::vector<CrossSection>& sections, std::size_t& begin,
                                       double max_variation_m);

/// Length of a run along the left border.
inline double length_of(std::span<const CrossSection> run) {
  return run.back().left_arc_m - run.front().left_arc_m;
}

/// The lane of a run.
Lane make_lane(std::span<const CrossSection> run, const LaneBorder& left, const LaneBorder& right);

}  // namespace laneloom::lanes
