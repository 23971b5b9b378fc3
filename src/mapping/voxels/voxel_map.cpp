#include "mapping/voxels/voxel_map.hpp"

#include <algorithm>
#include <cmath>

namespace laneloom::voxels {

MarkingType Voxel::likely_type() const {
  const auto best = std::max_element(detections.begin(), detections.end());
  return static_cast<MarkingType>(best - detections.begin());
}

VoxelMap::VoxelMap(const VoxelMapConfig& config)
    : voxel_size_m_(config.voxel_size_m, config.voxel_size_m, config.voxel_height_m) {}

VoxelIndex VoxelMap::index_of(const Point& point) const {
  return (point.array() / voxel_size_m_.array()).floor().cast<int>();
}

Point VoxelMap::center(const Voxel& voxel) const {
  return ((voxel.index.cast<double>().array() + 0.5) * voxel_size_m_.array()).matrix();
}

VoxelId VoxelMap::find_or_allocate(const VoxelIndex& index) {
  Block& block = block_at(block_key(index));
  VoxelId& slot = block.slots[cell(index)];
  if (slot != kNoVoxel) return slot;
  if (free_voxels_.empty()) {
    slot = slots();
    voxels_.emplace_back();
  } else {
    slot = free_voxels_.back();
    free_voxels_.pop_back();
    voxels_[slot] = Voxel{};
  }
  voxels_[slot].index = index;
  voxels_[slot].alive = true;
  ++block.used;
  return slot;
}

VoxelId VoxelMap::find(const VoxelIndex& index) const {
  const auto found = hash_.find(block_key(index));
  return found == hash_.end() ? kNoVoxel : blocks_[found->second].slots[cell(index)];
}

void VoxelMap::erase(VoxelId id) {
  Voxel& voxel = voxels_[id];
  const VoxelIndex key = block_key(voxel.index);
  const std::uint32_t block_slot = hash_.at(key);
  Block& block = blocks_[block_slot];
  block.slots[cell(voxel.index)] = kNoVoxel;
  voxel.alive = false;
  free_voxels_.push_back(id);
  if (--block.used == 0) {
    free_blocks_.push_back(block_slot);
    hash_.erase(key);
  }
}

VoxelIndex VoxelMap::block_key(const VoxelIndex& index) {
  return {index.x() >> kBlockBits, index.y() >> kBlockBits, index.z() >> kBlockBits};
}

std::size_t VoxelMap::cell(const VoxelIndex& index) {
  const int in_block = ((index.z() & kBlockMask) << (2 * kBlockBits)) |
                       ((index.y() & kBlockMask) << kBlockBits) | (index.x() & kBlockMask);
  return static_cast<std::size_t>(in_block);
}

VoxelMap::Block& VoxelMap::block_at(const VoxelIndex& key) {
  const auto [entry, is_new] = hash_.try_emplace(key, 0);
  if (!is_new) return blocks_[entry->second];
  if (free_blocks_.empty()) {
    entry->second = static_cast<std::uint32_t>(blocks_.size());
    blocks_.emplace_back();
  } else {
    entry->second = free_blocks_.back();
    free_blocks_.pop_back();
  }
  Block& block = blocks_[entry->second];
  block.key = key;
  block.used = 0;
  block.slots.fill(kNoVoxel);
  return block;
}

void VoxelMap::rebuild_hash() {
  hash_.clear();
  for (std::uint32_t i = 0; i < blocks_.size(); ++i) {
    if (blocks_[i].used > 0) hash_.emplace(blocks_[i].key, i);
  }
}

std::size_t VoxelMap::KeyHash::operator()(const VoxelIndex& key) const {
  // The primes of Niessner et al. 2013, whose voxel hashing the paper uses.
  const auto part = [](int value, std::size_t prime) { return static_cast<std::size_t>(value) * prime; };
  return part(key.x(), 73856093U) ^ part(key.y(), 19349669U) ^ part(key.z(), 83492791U);
}

}  // namespace laneloom::voxels
