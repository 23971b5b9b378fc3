#pragma once

#include <vector>

#include "mapping/geometry/map_box.hpp"
#include "mapping/markings/preprocess.hpp"
#include "mapping/voxels/co_observation.hpp"
#include "mapping/voxels/instances.hpp"
#include "mapping/voxels/voxel_map.hpp"

namespace laneloom::voxels {

/// The voxels that one frame touched.
struct TouchedVoxels {
  std::vector<VoxelId> all;                        ///< each once, in the order of the first touch
  std::vector<std::vector<VoxelId>> by_detection;  ///< parallel to the road markings
};

/// Integrates the road markings of one frame: samples each polyline, allocates the voxels that it meets
/// within `range`, and counts detections and co-observations (paper, Sec. III-B-2).
TouchedVoxels update_voxels(const std::vector<markings::ObservedMarking>& markings,
                            const geometry::MapBox& range, const VoxelMapConfig& config, VoxelMap& map,
                            CoObservation& co_observation);

/// The touched voxels with n* > alpha_n (paper, eq. 4) that are not yet in an instance of type l*.
std::vector<VoxelId> reliable_voxels(const std::vector<VoxelId>& touched, const VoxelMap& map,
                                     const Instances& instances, int min_detections);

}  // namespace laneloom::voxels
