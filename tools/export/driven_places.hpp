#pragma once

#include <array>
#include <cstddef>
#include <map>

#include "laneloom/types.hpp"

namespace laneloom::exports {

/// The places that drives passed so near that each should have seen the lines there. Memory grows with the
/// roads, not with the drives. Not thread-safe.
class DrivenPlaces {
 public:
  static constexpr double kReach_m = 16.0;  ///< from the vehicle to lines that it should have seen

  /// Notes that a drive was here. Drives are added one after another.
  void add(const Point& vehicle, std::size_t drive);
  /// The number of drives that passed a place.
  int passed(const Point& place) const;
  /// Whether the drive that was added last passed a place.
  bool passed_last(const Point& place, std::size_t drive) const;

 private:
  using Cell = std::array<int, 3>;  ///< x, y, level
  struct Passes {
    int drives = 0;
    std::size_t last = 0;
  };
  const Passes* find(const Point& place) const;

  std::map<Cell, Passes> cells_;
};

}  // namespace laneloom::exports
