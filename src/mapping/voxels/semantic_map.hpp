#pragma once

#include "mapping/voxels/co_observation.hpp"
#include "mapping/voxels/instances.hpp"
#include "mapping/voxels/voxel_map.hpp"

namespace laneloom::voxels {

/// The voxels, which of them were seen together, and the instances that they make (paper, Sec. III-B).
struct SemanticMap {
  VoxelMap voxels;
  CoObservation co_observation{};
  Instances instances{};

  template <class Archive>
  void serialize(Archive& archive) {
    archive(voxels, co_observation, instances);
  }
};

}  // namespace laneloom::voxels
