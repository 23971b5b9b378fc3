#include "mapping/voxels/semantic_voxels.hpp"

#include <algorithm>
#include <cmath>

namespace laneloom::voxels {
namespace {

/// Calls `visit` with points at most `step_m` apart along the line, both ends included.
template <class Visit>
void sample(const Polyline& line, double step_m, Visit&& visit) {
  visit(line.front());
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Point segment = line[i] - line[i - 1];
    const auto steps = std::max(1, static_cast<int>(std::ceil(segment.norm() / step_m)));
    for (int k = 1; k <= steps; ++k) visit(line[i - 1] + segment * (static_cast<double>(k) / steps));
  }
}

}  // namespace

TouchedVoxels update_voxels(const std::vector<markings::ObservedMarking>& markings,
                            const geometry::MapBox& range, const VoxelMapConfig& config, VoxelMap& map,
                            CoObservation& co_observation) {
  co_observation.begin_frame(config.remembered_frames, map);
  const std::uint64_t frame = co_observation.frame();
  TouchedVoxels touched;
  for (const markings::ObservedMarking& marking : markings) {
    std::vector<VoxelId>& voxels = touched.by_detection.emplace_back();
    sample(marking.points, config.sample_step_m, [&](const Point& point) {
      if (range.keeps(point)) voxels.push_back(map.find_or_allocate(map.index_of(point)));
    });
    std::ranges::sort(voxels);
    voxels.erase(std::unique(voxels.begin(), voxels.end()), voxels.end());
    for (const VoxelId id : voxels) {
      if (map[id].last_frame == frame) continue;
      map[id].last_frame = frame;
      touched.all.push_back(id);
    }
    co_observation.record(marking.type, marking.style, voxels, map);
  }
  return touched;
}

std::vector<VoxelId> reliable_voxels(const std::vector<VoxelId>& touched, const VoxelMap& map,
                                     const Instances& instances, int min_detections) {
  std::vector<VoxelId> reliable;
  for (const VoxelId id : touched) {
    const Voxel& voxel = map[id];
    const MarkingType type = voxel.likely_type();
    if (voxel.count(type) <= static_cast<std::uint32_t>(min_detections)) continue;
    if (voxel.instance != kNoElement && instances[voxel.instance].type == type) continue;
    reliable.push_back(id);
  }
  return reliable;
}

}  // namespace laneloom::voxels
