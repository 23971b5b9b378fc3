#pragma once

#include <cstddef>
#include <cstdint>

namespace laneloom {

/// The stages of one update, in order. Of those between preprocess and polylines, only the configured
/// method's run.
enum class Stage : std::uint8_t {
  preprocess,
  voxel_update,
  reliable_voxels,
  clustering,
  local_range,
  association,
  line_update,
  line_set,
  polylines,
  lane_boundaries,
  road_sections,
  lanes,
  linkages
};
inline constexpr std::size_t kStageCount = 13;
/// As it is called in tables: the enumerator.
const char* name(Stage stage);

/// Told of every update's begin and of its stages' ends. Whoever implements it owns the clock; the mapper has
/// none.
class StageObserver {
 public:
  virtual ~StageObserver() = default;
  virtual void update_begins() = 0;          ///< before the first stage
  virtual void stage_done(Stage stage) = 0;  ///< after each stage
};

}  // namespace laneloom
