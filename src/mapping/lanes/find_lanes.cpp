#include "mapping/lanes/find_lanes.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "mapping/boundaries/boundary_pairs.hpp"
#include "mapping/lanes/forks.hpp"
#include "mapping/lanes/lanes.hpp"
#include "mapping/lanes/one_sided_lanes.hpp"
#include "mapping/lanes/shoulders.hpp"
#include "mapping/lanes/unmarked_roads.hpp"

namespace laneloom::lanes {

FoundLanes find_lanes(boundaries::SectionGraph road, const geometry::Scene& scene, const LaneConfig& config) {
  const Eigen::Isometry3d& vehicle = scene.T_map_body();
  const auto pairs = boundary_pairs(road);
  const auto strips = generate_lanes(pairs, road.boundaries, vehicle.translation(), config);
  TakenSpace taken(strips);  // shoulders keep their space
  auto lanes = without_shoulders(strips, pairs, road.boundaries, vehicle, config);
  std::vector<Fork> forks = cut_at_forks(road.boundaries, config, lanes);
  auto inferred = divide_unmarked(pairs, road.boundaries, config, taken);
  std::ranges::move(one_sided_lanes(road, scene.box, config, taken), std::back_inserter(inferred));
  return {std::move(road.boundaries), std::move(lanes), std::move(inferred), std::move(forks)};
}

}  // namespace laneloom::lanes
