#pragma once

#include <span>
#include <vector>

/// Areas between two lines that part or join, where nobody drives. Ours.
namespace laneloom::lanes {

/// A place between two borders.
struct PlaceBetween {
  double along_m = 0.0;         ///< arc length on one of the borders
  double width_m = 0.0;         ///< between the borders
  bool may_be_crossed = false;  ///< one of the borders is a line that is not solid
};

/// Whether each of consecutive places lies in a gore: the borders meet at an end of the places, or would not
/// far beyond it, and neither border may be crossed from there to the place.
std::vector<bool> in_gore(std::span<const PlaceBetween> places);

}  // namespace laneloom::lanes
