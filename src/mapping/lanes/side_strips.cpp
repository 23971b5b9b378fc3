#include "mapping/lanes/side_strips.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "mapping/lanes/inferred_boundaries.hpp"

namespace laneloom::lanes {

void SideStrips::update(const geometry::Scene& scene, const LaneConfig& config, markings::IdSource& ids,
                        LaneLayout& layout, FrameReasons* reasons) {
  TakenSpace of_lanes;
  for (const Lane& lane : layout.lanes) of_lanes.add(lane.centerline, 0.5 * lane.width_m);
  const auto lies_in_lane = [&](const Point& point) { return of_lanes.contains(point); };
  tracks_.forget(lies_in_lane);
  std::erase_if(layout.side_strips,
                [&](const Lane& one) { return std::ranges::any_of(one.centerline, lies_in_lane); });

  LaneLayout found{.boundaries = std::move(layout.boundaries),
                   .lanes = std::exchange(layout.side_strips, {}),
                   .forks = layout.forks};
  FrameReasons told;
  found = tracks_.update(std::move(found), scene, config, ids, reasons != nullptr ? &told : nullptr);
  const std::map<ElementId, ElementId> renamed = tracks_.publish(found.lanes, ids);
  const auto rename = [&](auto& one) {
    if (const auto now = renamed.find(one.id); now != renamed.end()) one.id = now->second;
  };
  std::ranges::for_each(found.lanes, rename);
  std::ranges::for_each(told.lanes, rename);
  if (reasons != nullptr) std::ranges::move(told.lanes, std::back_inserter(reasons->lanes));
  layout.boundaries = std::move(found.boundaries);
  layout.side_strips = std::move(found.lanes);
}

}  // namespace laneloom::lanes
