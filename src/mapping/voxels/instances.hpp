#pragma once

#include <cstdint>
#include <vector>

#include "laneloom/types.hpp"
#include "mapping/voxels/voxel_map.hpp"

namespace laneloom::voxels {

/// A road marking as a set of voxels with a polyline (paper, eq. 5).
struct Instance {
  ElementId id = kNoElement;
  MarkingType type = MarkingType::laneline;
  std::vector<VoxelId> voxels;
  std::uint64_t observations = 0;  ///< number of detections that touched it
  std::int64_t first_seen_ns = 0;  ///< stamp of the frame that made it

  bool dirty = true;               ///< its voxels changed since the polyline was estimated
  Polyline points;                 ///< map frame; empty: too small to be vectorised
  std::vector<StyleRange> styles;  ///< along the points
  /// Ids of further stretches of a line that leaves the local range and comes back. The first stretch has the
  /// id of the instance.
  std::vector<ElementId> extra_ids;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(id, type, voxels, observations, first_seen_ns, dirty, points, styles, extra_ids);
  }
};

/// The instances, by ascending id.
class Instances {
 public:
  const std::vector<Instance>& all() const { return instances_; }
  std::vector<Instance>& all() { return instances_; }

  /// The instance of an id, which must exist.
  Instance& operator[](ElementId id) { return instances_[position(id)]; }
  const Instance& operator[](ElementId id) const { return instances_[position(id)]; }
  /// The place in all() of an id, which must exist.
  std::size_t position(ElementId id) const;

  /// Adds an empty instance. `id` must be greater than all others.
  Instance& create(ElementId id, MarkingType type, std::int64_t stamp_ns);
  void add(Instance& instance, VoxelId voxel, VoxelMap& map);
  /// Takes a voxel out of its instance; the instance may be left empty.
  void remove(VoxelId voxel, VoxelMap& map);
  void erase_empty();

  template <class Archive>
  void serialize(Archive& archive) {
    archive(instances_);
  }

 private:
  std::vector<Instance> instances_;
};

}  // namespace laneloom::voxels
