#pragma once

#include "laneloom/config.hpp"
#include "mapping/geometry/scene.hpp"
#include "mapping/markings/fused_markings.hpp"
#include "mapping/markings/id_source.hpp"
#include "mapping/markings/preprocess.hpp"
#include "mapping/markings/stage_log.hpp"
#include "mapping/voxels/semantic_map.hpp"

namespace laneloom {

/// The paper's method of fusion, by voxels (Sec. III-B and III-C). A value type.
class VoxelMapper {
 public:
  explicit VoxelMapper(const VoxelMapConfig& config) : map_{VoxelMap(config)} {}

  FusedMarkings fuse(const ObservedFrame& observed, const Scene& scene, const MapperConfig& config,
                     IdSource& ids, const StageLog& log);

  const SemanticMap& map() const { return map_; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(map_);
  }

 private:
  void clear_outside(const MapBox& box);

  SemanticMap map_;
};

}  // namespace laneloom
