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
    for_each_tile(vertex, kReach_m, [&](const Tile& tile) { tiles_[tile].insert(line); });
  }
  /// The lines that may come within kReach_m of a place, in ascending order.
  const std::set<std::size_t>& near(const Point& place) const {
    static const std::set<std::size_t> kNone;
    const auto found = tiles_.find(tile_of(place));
    return found == tiles_.end() ? kNone : found->second;
  }
  /// Adds the lines that may come within a distance of a place.
  void add_within(double distance_m, const Point& place, std::set<std::size_t>& lines) const {
    for_each_tile(place, distance_m, [&](const Tile& tile) {
      if (const auto found = tiles_.find(tile); found != tiles_.end())
        lines.insert(found->second.begin(), found->second.end());
    });
  }

 private:
  using Tile = std::array<int, 2>;
  static constexpr double kTile_m = 16.0;
  static Tile tile_of(const Point& point) {
    return {static_cast<int>(std::floor(point.x() / kTile_m)),
            static_cast<int>(std::floor(point.y() / kTile_m))};
  }
  template <class Visit>
  static void for_each_tile(const Point& place, double distance_m, const Visit& visit) {
    const Point reach(distance_m, distance_m, 0.0);
    const Tile from = tile_of(place - reach), to = tile_of(place + reach);
    for (int x = from[0]; x <= to[0]; ++x)
      for (int y = from[1]; y <= to[1]; ++y) visit({x, y});
  }

  std::map<Tile, std::set<std::size_t>> tiles_;
};

}  // namespace laneloom::exports
