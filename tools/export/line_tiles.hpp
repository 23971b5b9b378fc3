#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>

#include "laneloom/types.hpp"

namespace laneloom::exports {

/// An index of lines by place, so that a question about a place costs the same on a road of any length.
class LineTiles {
 public:
  static constexpr double kReach_m = 3.0;  ///< a line is in all tiles to which it comes as near

  void add(std::size_t line, const Point& vertex) {
    for (const double dx : {-kReach_m, kReach_m})
      for (const double dy : {-kReach_m, kReach_m}) tiles_[tile_of(vertex + Point(dx, dy, 0))].insert(line);
  }
  /// The lines that may come within kReach_m of a place, in ascending order.
  const std::set<std::size_t>& near(const Point& place) const {
    static const std::set<std::size_t> kNone;
    const auto found = tiles_.find(tile_of(place));
    return found == tiles_.end() ? kNone : found->second;
  }

 private:
  using Tile = std::array<int, 2>;
  static constexpr double kTile_m = 16.0;
  static Tile tile_of(const Point& point) {
    return {static_cast<int>(std::floor(point.x() / kTile_m)),
            static_cast<int>(std::floor(point.y() / kTile_m))};
  }

  std::map<Tile, std::set<std::size_t>> tiles_;
};

}  // namespace laneloom::exports
