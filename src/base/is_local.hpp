#pragma once

#include <algorithm>

#include "laneloom/types.hpp"

namespace laneloom {

/// Whether all lines of a map are within 100 km of the vehicle. Readers of maps go along lines metre by
/// metre, which would not end on a line that is as long as a number can be.
inline bool is_local(const LocalMap& map) {
  constexpr double kFarthest_m = 1e5;
  const Point vehicle = map.T_map_body.translation();
  const auto near = [&](const Polyline& line) {
    return std::ranges::all_of(line,
                               [&](const Point& point) { return (point - vehicle).norm() <= kFarthest_m; });
  };
  const auto all_near = [&](const auto& elements, const auto& line) {
    return std::ranges::all_of(elements, near, line);
  };
  return all_near(map.boundaries, &Marking::points) && all_near(map.lanes, &Lane::left) &&
         all_near(map.lanes, &Lane::right) && all_near(map.lanes, &Lane::centerline) &&
         all_near(map.driven_paths, &DrivenPath::points) &&
         all_near(map.stoplines, [](const Stopline& one) -> const Polyline& { return one.marking.points; });
}

}  // namespace laneloom
