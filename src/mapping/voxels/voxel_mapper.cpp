#include "mapping/voxels/voxel_mapper.hpp"

#include <cstddef>

#include "mapping/voxels/clustering.hpp"
#include "mapping/voxels/semantic_voxels.hpp"
#include "mapping/voxels/vectorise.hpp"

namespace laneloom::voxels {

markings::FusedMarkings VoxelMapper::fuse(markings::ObservedFrame observed, const geometry::Scene& scene,
                                          const MapperConfig& config, markings::IdSource& ids,
                                          const markings::StageLog& log) {
  auto& [voxels, co_observation, instances] = map_;
  const std::size_t unsure = drop_unsure(config.preprocess, observed.markings);
  const auto touched = log.done(Stage::voxel_update, update_voxels(observed.markings, scene.box,
                                                                   config.voxel_map, voxels, co_observation));
  const auto reliable = log.done(Stage::reliable_voxels, reliable_voxels(touched.all, voxels, instances,
                                                                         config.voxel_map.min_detections));
  cluster(reliable, config.clustering, observed.frame.stamp_ns, map_, ids);
  count_observations(touched.by_detection, voxels, instances);
  log.done(Stage::clustering);
  clear_outside(scene.box);
  log.done(Stage::local_range);
  const Eigen::Vector2d forward = observed.T_map_body.linear().col(0).head<2>();
  update_polylines(config.polyline, config.style, voxels, forward, instances);
  auto markings = markings_in_range(scene.box, config.polyline.min_length_m, instances, ids);
  return log.done(Stage::polylines, markings::FusedMarkings{std::move(markings), {}, {}, unsure});
}

/// Removes voxels outside of the local range and its margin (paper, Sec. IV-C).
void VoxelMapper::clear_outside(const geometry::MapBox& box) {
  auto& [voxels, co_observation, instances] = map_;
  for (VoxelId id = 0; id < voxels.slots(); ++id) {
    const Voxel& voxel = voxels[id];
    if (!voxel.alive || box.keeps(voxels.center(voxel))) continue;
    if (voxel.instance != kNoElement) instances.remove(id, voxels);
    co_observation.erase(id);
    voxels.erase(id);
  }
  instances.erase_empty();
}

}  // namespace laneloom::voxels
