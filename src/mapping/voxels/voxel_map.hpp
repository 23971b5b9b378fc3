#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"

namespace laneloom::voxels {

/// Slot of a voxel in the pool. Reused after the voxel was erased.
using VoxelId = std::uint32_t;
inline constexpr VoxelId kNoVoxel = 0xffffffff;

using VoxelIndex = Eigen::Vector3i;  ///< floor(point / voxel size), per axis

/// A voxel (paper, eq. 2). It counts the detections that are remembered.
struct Voxel {
  VoxelIndex index = VoxelIndex::Zero();
  std::array<std::uint32_t, kMarkingTypeCount> detections{};  ///< n_o: count by type
  std::array<std::uint32_t, kMarkingStyleCount> styles{};     ///< count by style
  ElementId instance = kNoElement;                            ///< the instance that it belongs to
  std::uint64_t last_frame = 0;                               ///< the last frame that touched it
  bool alive = false;                                         ///< else the slot is free

  /// The most likely marking type l*; of equals, the first one.
  MarkingType likely_type() const;
  std::uint32_t count(MarkingType type) const { return detections[laneloom::index(type)]; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(index, detections, styles, instance, last_frame, alive);
  }
};

/// Semantic voxel map (paper, Sec. III-B-1): blocks of 8x8x8 voxels behind a spatial hash. A block holds
/// slots of a dense pool, so that voxels are walked in the order of their slots, never in hash order.
class VoxelMap {
 public:
  explicit VoxelMap(const VoxelMapConfig& config);

  VoxelIndex index_of(const Point& point) const;
  Point center(const Voxel& voxel) const;

  /// The voxel at `index`. It is allocated if nothing was observed there before.
  VoxelId find_or_allocate(const VoxelIndex& index);
  /// The voxel at `index`. kNoVoxel: nothing was observed there.
  VoxelId find(const VoxelIndex& index) const;
  void erase(VoxelId id);

  Voxel& operator[](VoxelId id) { return voxels_[id]; }
  const Voxel& operator[](VoxelId id) const { return voxels_[id]; }
  /// Number of slots, of living voxels and free ones.
  VoxelId slots() const { return static_cast<VoxelId>(voxels_.size()); }
  std::size_t living() const { return voxels_.size() - free_voxels_.size(); }
  std::size_t blocks() const { return blocks_.size() - free_blocks_.size(); }

  template <class Archive>
  void save(Archive& archive) const {
    archive(voxels_, free_voxels_, blocks_, free_blocks_);
  }
  template <class Archive>
  void load(Archive& archive) {
    archive(voxels_, free_voxels_, blocks_, free_blocks_);
    rebuild_hash();
  }

 private:
  static constexpr int kBlockBits = 3;
  static constexpr int kBlockMask = (1 << kBlockBits) - 1;
  static constexpr std::size_t kBlockVoxels = 1U << (3 * kBlockBits);

  /// A cube of voxels.
  struct Block {
    VoxelIndex key = VoxelIndex::Zero();        ///< index of its voxels without their lowest bits
    std::uint32_t used = 0;                     ///< number of its voxels that are alive
    std::array<VoxelId, kBlockVoxels> slots{};  ///< kNoVoxel: not allocated
    template <class Archive>
    void serialize(Archive& archive) {
      archive(key, used, slots);
    }
  };
  struct KeyHash {
    std::size_t operator()(const VoxelIndex& key) const;
  };

  static VoxelIndex block_key(const VoxelIndex& index);
  static std::size_t cell(const VoxelIndex& index);
  Block& block_at(const VoxelIndex& key);
  void rebuild_hash();

  Eigen::Vector3d voxel_size_m_;
  std::vector<Voxel> voxels_;
  std::vector<VoxelId> free_voxels_;
  std::vector<Block> blocks_;
  std::vector<std::uint32_t> free_blocks_;
  std::unordered_map<VoxelIndex, std::uint32_t, KeyHash> hash_;
};

}  // namespace laneloom::voxels
