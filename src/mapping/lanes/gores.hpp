#pragma once

#include <cstddef>
#include <limits>
#include <span>

/// Areas between two lines that part or join, where nobody drives. Ours.
namespace laneloom::lanes {

/// A place between two borders.
struct PlaceBetween {
  double along_m = 0.0;         ///< arc length on one of the borders
  double width_m = 0.0;         ///< between the borders
  bool may_be_crossed = false;  ///< one of the borders is a line that is not solid
};

/// Which of consecutive places lie in a gore.
struct GorePlaces {
  std::size_t up_to = 0;                                       ///< the places before this one do
  std::size_t from = std::numeric_limits<std::size_t>::max();  ///< and so do those from this one on

  bool contains(std::size_t place) const { return place < up_to || place >= from; }
};

/// Finds the places that lie in a gore: the borders meet at an end of the places, or would not far beyond it,
/// and neither border may be crossed from there to the place.
GorePlaces in_gore(std::span<const PlaceBetween> places);

}  // namespace laneloom::lanes
