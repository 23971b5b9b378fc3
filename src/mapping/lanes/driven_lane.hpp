#pragma once

#include <optional>
#include <span>

#include "mapping/lanes/cross_sections.hpp"

namespace laneloom::lanes {

/// A lane beside the line that bounds it on one side.
struct LaneBesideLine {
  Side line = Side::left;
  double width_m = 0.0;

  /// The width of the left one of two lanes, of which this is one.
  double left_m(double both_m) const { return line == Side::left ? width_m : both_m - width_m; }
};

/// The lane that the vehicle drives in, where two lanes lie between a line and a kerb: it keeps to the middle
/// of its lane. What is left may be wider, because cars park there. `way` are places of the vehicle, some
/// metres apart. Empty: it drove elsewhere, or for too short a way. Ours.
std::optional<LaneBesideLine> driven_beside_line(std::span<const Point> way, Side line,
                                                 std::span<const CrossSection> both);

}  // namespace laneloom::lanes
