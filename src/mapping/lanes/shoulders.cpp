#include "mapping/lanes/shoulders.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "mapping/lanes/inferred_boundaries.hpp"

namespace laneloom::lanes {
namespace {

constexpr double kProbability = 0.95;  // that a strip is a shoulder rather than a lane

}  // namespace

void Shoulders::update(const geometry::Scene& scene, const LaneConfig& config, markings::IdSource& ids,
                       LaneLayout& layout, FrameReasons* reasons) {
  TakenSpace of_lanes;
  for (const Lane& lane : layout.lanes) of_lanes.add(lane.centerline, 0.5 * lane.width_m);
  const auto lies_in_lane = [&](const Point& point) { return of_lanes.contains(point); };
  tracks_.forget(lies_in_lane);
  std::erase_if(layout.shoulders,
                [&](const Lane& one) { return std::ranges::any_of(one.centerline, lies_in_lane); });

  LaneLayout found{.boundaries = std::move(layout.boundaries),
                   .lanes = std::exchange(layout.shoulders, {}),
                   .forks = layout.forks};
  FrameReasons told;
  found = tracks_.update(std::move(found), scene, config, ids, reasons != nullptr ? &told : nullptr);
  const std::map<ElementId, ElementId> renamed = tracks_.publish(found.lanes, ids);
  const auto rename = [&](auto& one) {
    if (const auto now = renamed.find(one.id); now != renamed.end()) one.id = now->second;
  };
  for (Lane& shoulder : found.lanes) {
    rename(shoulder);
    shoulder.use = Lane::Use::shoulder;
    shoulder.use_probability = kProbability;
  }
  std::ranges::for_each(told.lanes, rename);
  if (reasons != nullptr) std::ranges::move(told.lanes, std::back_inserter(reasons->lanes));
  layout.boundaries = std::move(found.boundaries);
  layout.shoulders = std::move(found.lanes);
}

}  // namespace laneloom::lanes
