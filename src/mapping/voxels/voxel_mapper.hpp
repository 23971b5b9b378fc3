#pragma once

#include "laneloom/config.hpp"
#include "mapping/geometry/scene.hpp"
#include "mapping/markings/fused_markings.hpp"
#include "mapping/markings/id_source.hpp"
#include "mapping/markings/preprocess.hpp"
#include "mapping/markings/stage_log.hpp"
#include "mapping/voxels/semantic_map.hpp"

namespace laneloom::voxels {

/// The paper's method of fusion, by voxels (Sec. III-B and III-C). A value type.
class VoxelMapper {
 public:
  explicit VoxelMapper(const VoxelMapConfig& config) : map_{VoxelMap(config)} {}

  markings::FusedMarkings fuse(markings::ObservedFrame observed, const geometry::Scene& scene,
                               const MapperConfig& config, markings::IdSource& ids,
                               const markings::StageLog& log);

  const SemanticMap& map() const { return map_; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(map_);
  }

 private:
  void clear_outside(const geometry::MapBox& box);

  SemanticMap map_;
};

}  // namespace laneloom::voxels
