#pragma once

#include <cstdint>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "mapping/alignment.hpp"
#include "mapping/co_observation.hpp"
#include "mapping/ego_track.hpp"
#include "mapping/instances.hpp"
#include "mapping/joints.hpp"
#include "mapping/lane_identity.hpp"
#include "mapping/line_map.hpp"
#include "mapping/line_merging.hpp"
#include "mapping/lineage.hpp"
#include "mapping/voxel_map.hpp"

namespace laneloom {

/// Everything that a mapper knows: a value without pointers, to be copied, saved and loaded.
struct MapperState {
  explicit MapperState(const VoxelMapConfig& config) : voxels(config) {}

  std::uint64_t frame = 0;  ///< how many were fused
  VoxelMap voxels;
  CoObservation co_observation;
  Instances instances;
  std::vector<Line> lines;
  std::vector<LinePair> pairs;  ///< of lines that lie side by side
  std::vector<Joint> joints;    ///< of lines that end at each other
  FrameError lasting_error = FrameError::Zero();
  std::vector<KnownLane> known_lanes;
  EgoTrack ego_track;
  Membership published;   ///< of the last map
  ElementId next_id = 1;  ///< never used before
  LocalMap map;           ///< the last one

  template <class Archive>
  void serialize(Archive& archive) {
    archive(frame, voxels, co_observation, instances, lines, pairs, joints, lasting_error, known_lanes,
            ego_track, published, next_id, map);
  }
};

}  // namespace laneloom
