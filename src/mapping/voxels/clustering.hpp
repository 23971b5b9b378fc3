#pragma once

#include <cstdint>
#include <vector>

#include "laneloom/config.hpp"
#include "mapping/markings/id_source.hpp"
#include "mapping/voxels/semantic_map.hpp"

namespace laneloom::voxels {

/// Gives every newly reliable voxel to the instance of its type with which it was seen most, or to a new
/// instance (paper, Sec. III-C-1). A voxel whose likely type has changed leaves its former instance.
void cluster(const std::vector<VoxelId>& reliable, const ClusteringConfig& config, std::int64_t stamp_ns,
             SemanticMap& semantic_map, markings::IdSource& ids);

/// Counts one observation for every instance that a detection touched.
void count_observations(const std::vector<std::vector<VoxelId>>& touched_by_detection, const VoxelMap& map,
                        Instances& instances);

}  // namespace laneloom::voxels
