#pragma once

#include <algorithm>

#include "laneloom/types.hpp"

namespace laneloom {

/// Whether readers of a map can go along its lines metre by metre: each line is within 100 km of the vehicle
/// and no longer than that, and those of lanes and driven paths have points.
inline bool is_local(const LocalMap& map) {
  constexpr double kFarthest_m = 1e5;
  const Point vehicle = map.T_map_body.translation();
  const auto is_walkable = [&](const Polyline& line) {
    double length_m = 0.0;
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (!((line[i] - vehicle).norm() <= kFarthest_m)) return false;
      if (i > 0) length_m += (line[i] - line[i - 1]).norm();
    }
    return length_m <= kFarthest_m;
  };
  const auto all_walkable = [&](const auto& elements, const auto& line) {
    return std::ranges::all_of(elements, is_walkable, line);
  };
  const auto none_empty = [](const auto& elements, const auto& line) {
    return std::ranges::none_of(elements, &Polyline::empty, line);
  };
  return none_empty(map.lanes, &Lane::centerline) && none_empty(map.driven_paths, &DrivenPath::points) &&
         all_walkable(map.boundaries, &Marking::points) && all_walkable(map.lanes, &Lane::left) &&
         all_walkable(map.lanes, &Lane::right) && all_walkable(map.lanes, &Lane::centerline) &&
         all_walkable(map.linkages, &Linkage::path) && all_walkable(map.driven_paths, &DrivenPath::points) &&
         all_walkable(map.stoplines,
                      [](const Stopline& one) -> const Polyline& { return one.marking.points; });
}

}  // namespace laneloom
