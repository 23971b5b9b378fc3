#pragma once

#include <utility>
#include <vector>

#include "simulation/road_builder.hpp"

/// Makes the lines along a street, and the lanes between them, of the street's section.
namespace laneloom::simulation {

inline constexpr double kMinLaneWidth_m = 2.5;  // a narrower strip between two borders is no lane

/// One line along a street.
struct Border {
  MarkingType type = MarkingType::laneline;
  MarkingStyle style = MarkingStyle::solid;
  Profile left_m;  ///< offset from the reference line
  double from_m = 0.0;
  double to_m = 0.0;
  bool painted = true;  ///< whether there is something to be seen
};

/// All lines of a street of a given length.
std::vector<Border> borders(const Section& section, double length_m);

/// A stretch of a street along which a lane runs between two of its borders.
struct LaneStretch {
  std::size_t left_border = 0;  ///< as seen along the reference line
  std::size_t right_border = 0;
  bool forward = true;
  std::vector<double> stations_m;  ///< samples along the reference line
};

/// The lanes between neighbouring borders, cut where any lane of their direction begins or ends.
std::vector<LaneStretch> lane_stretches(const std::vector<Border>& borders, double length_m);

/// Samples along a street: every metre or less, and wherever one of the borders begins or ends.
std::vector<double> stations(const std::vector<Border>& borders, double from_m, double to_m);

}  // namespace laneloom::simulation
