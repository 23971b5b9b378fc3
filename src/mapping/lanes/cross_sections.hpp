#pragma once

#include <optional>
#include <span>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/polyline.hpp"
#include "laneloom/types.hpp"
#include "mapping/boundaries/boundary_pairs.hpp"

/// What lies between two boundaries, across them, and the lanes that it makes.
namespace laneloom {

/// Which stretches of a boundary's one side belong to a lane already.
using Occupied = std::vector<Stretch>;

/// A boundary, as a lane beside it runs. Refers to what it is made of.
class LaneBorder {
 public:
  LaneBorder(const LaneBoundary& boundary, bool reversed, const Occupied& occupied);
  const MeasuredPolyline& line() const { return reversed_ ? turned_ : boundary_.course; }
  const Marking& marking() const { return boundary_.marking; }
  bool reversed() const { return reversed_; }
  bool is_free(double arc_m) const;
  bool is_bridged(double arc_m) const;
  /// On the boundary as it runs itself.
  Stretch own(const Stretch& range) const {
    return reversed_ ? Stretch{own(range.to_m), own(range.from_m)} : range;
  }

 private:
  double own(double arc_m) const { return reversed_ ? boundary_.course.length() - arc_m : arc_m; }

  const LaneBoundary& boundary_;
  bool reversed_;
  MeasuredPolyline turned_;
  const Occupied& occupied_;
};

/// A sample on the right boundary with its foot on the left one.
struct CrossSection {
  double left_arc_m = 0.0;
  double right_arc_m = 0.0;
  double width_m = 0.0;
  bool wide = false;  ///< more than lanes between lines are
  Point left = Point::Zero();
  Point right = Point::Zero();
  bool valid = false;

  Point middle() const { return 0.5 * (left + right); }
};

/// What lies between two boundaries.
struct Between {
  bool is_edge = false;
  double share = 0.0;  ///< its distance from the left one, as a share of the width
};

/// An edge, however sure, or else a confirmed line that runs along the pair's boundaries: between them, but
/// beside neither. Empty: there is none.
std::optional<Between> find_between(const CrossSection& section, const BoundaryPair& pair,
                                    const Boundaries& boundaries);

struct WidthLimits {
  double min_m = 0.0, max_m = 0.0;
};

/// Along the right border, where both are free and their distance lies within the limits; elsewhere not
/// valid.
std::vector<CrossSection> cross_sections(const LaneBorder& left, const LaneBorder& right,
                                         const WidthLimits& limits, const LaneConfig& config);

/// The next run from `begin` on, which is moved behind it: the width varies by no more than is said, and the
/// left boundary is followed. Without its narrow ends where it is wider elsewhere: there a lane opens or
/// closes beside another.
std::span<const CrossSection> next_run(const std::vector<CrossSection>& sections, std::size_t& begin,
                                       double max_variation_m);

/// Along the left boundary.
inline double length_of(std::span<const CrossSection> run) {
  return run.back().left_arc_m - run.front().left_arc_m;
}

/// The lane of a run.
Lane make_lane(std::span<const CrossSection> run, const LaneBorder& left, const LaneBorder& right);

}  // namespace laneloom
