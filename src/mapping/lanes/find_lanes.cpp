#include "mapping/lanes/find_lanes.hpp"

#include <utility>

#include "mapping/lanes/forks.hpp"
#include "mapping/lanes/lane_choice.hpp"
#include "mapping/lanes/paper_lanes.hpp"

namespace laneloom::lanes {

FoundLanes find_lanes(boundaries::SectionGraph road, const geometry::MapBox& box, const Driven& driven,
                      const KnownRoad& known, const LaneConfig& config) {
  if (config.method == LaneMethod::paper) return paper_lanes(std::move(road), config);
  FoundLanes found = choose_lanes(road, box, driven, known, config);
  found.boundaries = std::move(road.boundaries);
  found.forks = cut_at_forks(found.boundaries, config, found.lanes);
  return found;
}

}  // namespace laneloom::lanes
