#include "mapping/voxels/instances.hpp"

#include <algorithm>
#include <cassert>

namespace laneloom::voxels {

std::size_t Instances::position(ElementId id) const {
  const auto found = std::ranges::lower_bound(instances_, id, {}, &Instance::id);
  assert(found != instances_.end() && found->id == id);
  return static_cast<std::size_t>(found - instances_.begin());
}

Instance& Instances::create(ElementId id, MarkingType type, std::int64_t stamp_ns) {
  assert(instances_.empty() || instances_.back().id < id);
  Instance& instance = instances_.emplace_back();
  instance.id = id;
  instance.type = type;
  instance.first_seen_ns = stamp_ns;
  return instance;
}

void Instances::add(Instance& instance, VoxelId voxel, VoxelMap& map) {
  instance.voxels.push_back(voxel);
  instance.dirty = true;
  map[voxel].instance = instance.id;
}

void Instances::remove(VoxelId voxel, VoxelMap& map) {
  Instance& instance = (*this)[map[voxel].instance];
  instance.voxels.erase(std::ranges::find(instance.voxels, voxel));
  instance.dirty = true;
  map[voxel].instance = kNoElement;
}

void Instances::erase_empty() {
  std::erase_if(instances_, [](const Instance& instance) { return instance.voxels.empty(); });
}

}  // namespace laneloom::voxels
