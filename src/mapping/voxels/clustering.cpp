#include "mapping/voxels/clustering.hpp"

#include <algorithm>

namespace laneloom::voxels {
namespace {

/// h_k of the paper, for every instance: the number of its voxels that were seen together with voxel `id`
/// often enough.
std::vector<int> count_likely(VoxelId id, const ClusteringConfig& config, const VoxelMap& map,
                              CoObservation& co_observation, const Instances& instances) {
  const MarkingType type = map[id].likely_type();
  std::vector<int> likely(instances.all().size(), 0);
  for (const CoObserved& other : co_observation.row(id)) {
    const Voxel& voxel = map[other.voxel];
    if (voxel.instance == kNoElement) continue;
    const std::size_t position = instances.position(voxel.instance);
    if (instances.all()[position].type != type) continue;
    // max(A / n_j, A / n_k) is A over the smaller count. A count is 0 if all detections of this type are
    // forgotten.
    const auto fewer = std::min(voxel.count(type), map[id].count(type));
    if (other.count > config.min_probability * fewer && fewer > 0) ++likely[position];
  }
  return likely;
}

/// The instance with the highest count that satisfies beta_n or beta_r; of equals, the oldest. Null: there is
/// none.
Instance* best_match(const std::vector<int>& likely, const ClusteringConfig& config, Instances& instances) {
  Instance* best = nullptr;
  int best_count = 0;
  for (std::size_t i = 0; i < likely.size(); ++i) {
    Instance& instance = instances.all()[i];
    const auto size = static_cast<double>(instance.voxels.size());
    const bool matches = likely[i] > config.min_voxels || likely[i] > config.min_ratio * size;
    if (!matches || likely[i] <= best_count) continue;
    best = &instance;
    best_count = likely[i];
  }
  return best;
}

/// The instance with the nearest voxel, among the instances that were ever seen together with voxel `id` (the
/// paper's ablation, Sec. IV-F). Null: there is none.
Instance* nearest_match(VoxelId id, const VoxelMap& map, CoObservation& co_observation,
                        Instances& instances) {
  const Point center = map.center(map[id]);
  Instance* best = nullptr;
  double best_m2 = 0.0;
  for (const CoObserved& other : co_observation.row(id)) {
    const Voxel& voxel = map[other.voxel];
    if (voxel.instance == kNoElement) continue;
    Instance& instance = instances[voxel.instance];
    if (instance.type != map[id].likely_type()) continue;
    const double distance_m2 = (map.center(voxel) - center).squaredNorm();
    if (best != nullptr && distance_m2 >= best_m2) continue;
    best = &instance;
    best_m2 = distance_m2;
  }
  return best;
}

}  // namespace

void cluster(const std::vector<VoxelId>& reliable, const ClusteringConfig& config, std::int64_t stamp_ns,
             SemanticMap& semantic_map, markings::IdSource& ids) {
  auto& [map, co_observation, instances] = semantic_map;
  for (const VoxelId id : reliable) {
    if (map[id].instance != kNoElement) instances.remove(id, map);
    Instance* instance =
        config.nearest_instance
            ? nearest_match(id, map, co_observation, instances)
            : best_match(count_likely(id, config, map, co_observation, instances), config, instances);
    if (instance == nullptr) instance = &instances.create(ids.next(), map[id].likely_type(), stamp_ns);
    instances.add(*instance, id, map);
  }
  instances.erase_empty();
}

void count_observations(const std::vector<std::vector<VoxelId>>& touched_by_detection, const VoxelMap& map,
                        Instances& instances) {
  std::vector<ElementId> seen;
  for (const auto& voxels : touched_by_detection) {
    seen.clear();
    for (const VoxelId id : voxels) {
      if (map[id].instance != kNoElement) seen.push_back(map[id].instance);
    }
    std::ranges::sort(seen);
    seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
    for (const ElementId id : seen) ++instances[id].observations;
  }
}

}  // namespace laneloom::voxels
