#pragma once

#include <cstddef>
#include <cstdint>

namespace laneloom {

/// The stages of one update, in order. The method `voxels` skips those of `lines`, and the reverse.
enum class Stage : std::uint8_t {
  preprocess,       ///< drops zigzags, and takes the rest to the map frame
  voxel_update,     ///< `voxels`: counts the voxels that detections touch
  reliable_voxels,  ///< `voxels`: finds voxels that were detected often enough
  clustering,       ///< `voxels`: joins reliable voxels to instances
  local_range,      ///< `voxels`: forgets voxels outside the box
  association,      ///< `lines`: matches detections with lines
  line_update,      ///< `lines`: moves the lines and their evidence
  line_set,         ///< `lines`: extends, creates, merges and removes lines
  polylines,        ///< makes markings of instances or lines
  lane_boundaries,  ///< joins markings to boundaries
  road_sections,    ///< groups boundaries that run side by side
  lanes,            ///< builds lanes between boundaries, and gives them their ids
  linkages,         ///< links lanes, finds their directions, and ties stoplines to them
  way               ///< makes the own way
};
inline constexpr std::size_t kStageCount = 14;
/// The name of the enumerator.
const char* name(Stage stage);

struct FrameReasons;

/// Is told when an update begins and when each of its stages ends, so that it can measure times. The mapper
/// has no clock of its own.
class StageObserver {
 public:
  virtual ~StageObserver() = default;
  virtual void update_begins() = 0;          ///< before the first stage
  virtual void stage_done(Stage stage) = 0;  ///< after each stage that the method runs
  /// The place for the reasons of an update (reasons.hpp): the same at all stages of it. Null: nobody asks
  /// why, and nothing is noted.
  virtual FrameReasons* reasons() { return nullptr; }
};

}  // namespace laneloom
