#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "laneloom/polyline.hpp"
#include "simulation/road.hpp"

/// Checks of every lane of every road.
namespace laneloom {

inline const simulation::RoadLane& lane_of(const simulation::Road& road, ElementId id) {
  return *std::find_if(road.lanes.begin(), road.lanes.end(),
                       [&](const simulation::RoadLane& l) { return l.id == id; });
}

inline void expect_left_is_left(const simulation::RoadLane& lane) {
  const MeasuredPolyline left(lane.left), right(lane.right), centre(lane.centerline);
  const Point middle = centre.at(0.5 * centre.length());
  EXPECT_LT(left.project(middle).lateral_m, 0.0) << "lane " << lane.id;
  EXPECT_GT(right.project(middle).lateral_m, 0.0) << "lane " << lane.id;
}

inline void expect_successors_meet(const simulation::Road& road, const simulation::RoadLane& lane,
                                   double tolerance_m) {
  for (const ElementId id : lane.successors) {
    const simulation::RoadLane& next = lane_of(road, id);
    const double gap_m = std::min(
        {(lane.left.back() - next.left.front()).norm(), (lane.right.back() - next.right.front()).norm(),
         (lane.left.back() - next.right.front()).norm(), (lane.right.back() - next.left.front()).norm()});
    EXPECT_LT(gap_m, tolerance_m) << "from lane " << lane.id << " to " << id;
  }
}

/// Every border that names a marking runs on it.
inline void expect_borders_on_markings(const simulation::Road& road, double tolerance_m) {
  std::map<ElementId, MeasuredPolyline> markings;
  for (const simulation::RoadMarking& marking : road.markings)
    markings[marking.id] = MeasuredPolyline(marking.points);
  for (const simulation::RoadLane& lane : road.lanes) {
    for (const auto& [id, border] :
         {std::pair(lane.left_marking, &lane.left), {lane.right_marking, &lane.right}}) {
      if (id == kNoElement) continue;
      const Point middle = MeasuredPolyline(*border).at(0.5 * length(*border));
      ASSERT_TRUE(markings.contains(id)) << "lane " << lane.id;
      EXPECT_LT(markings[id].project(middle).distance_m, tolerance_m)
          << "lane " << lane.id << " marking " << id;
    }
  }
}

}  // namespace laneloom
