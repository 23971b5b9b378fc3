#pragma once

#include <cstdint>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "mapping/lanes/inferred_boundaries.hpp"
#include "mapping/lanes/lane_identity.hpp"
#include "mapping/lineage.hpp"
#include "mapping/lines/frame_alignment.hpp"
#include "mapping/lines/line_map.hpp"
#include "mapping/lines/networks.hpp"
#include "mapping/markings/pair_history.hpp"
#include "mapping/topology/ego_track.hpp"
#include "mapping/voxels/co_observation.hpp"
#include "mapping/voxels/instances.hpp"
#include "mapping/voxels/voxel_map.hpp"

namespace laneloom {

/// Everything that a mapper knows: a value without pointers, to be copied, saved and loaded.
struct MapperState {
  explicit MapperState(const VoxelMapConfig& config) : voxels(config) {}

  std::uint64_t frame = 0;  ///< how many were fused
  VoxelMap voxels;
  CoObservation co_observation;
  Instances instances;
  std::vector<Line> lines;
  PairHistories doubles;  ///< of lines that lie side by side
  PairHistories joints;   ///< of ends of lines that lie near each other
  FrameError lasting_error = FrameError::Zero();
  Networks networks;  ///< what was learned of the sources
  std::vector<KnownInferred> known_inferred;
  std::vector<KnownLane> known_lanes;
  EgoTrack ego_track;
  Membership published;   ///< of the last map
  ElementId next_id = 1;  ///< never used before
  LocalMap map;           ///< the last one

  template <class Archive>
  void serialize(Archive& archive) {
    archive(frame, voxels, co_observation, instances, lines, doubles, joints, lasting_error, networks,
            known_inferred, known_lanes, ego_track, published, next_id, map);
  }
};

}  // namespace laneloom
