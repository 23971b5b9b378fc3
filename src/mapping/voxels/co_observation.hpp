#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "mapping/voxels/voxel_map.hpp"

namespace laneloom::voxels {

/// A voxel that was seen together with a given one.
struct CoObserved {
  VoxelId voxel = kNoVoxel;
  std::uint32_t count = 0;  ///< A(v_p, v_q)
};

/// The co-observation matrix A of the paper (eq. 3), without the matrix.
///
/// A(v_p, v_q) is the number of detections that touched both voxels. Instead of a count per pair, which costs
/// the square of a detection's voxels and never shrinks, every remembered detection lists its voxels, and
/// every voxel lists its detections: recording is linear in the voxels touched, and a row of A is read by
/// walking the voxel's detections. Detections older than a number of frames are forgotten, in A and in the
/// voxels' counts alike, so that memory is bounded and the ratios of both stay right also where the vehicle
/// stands still.
class CoObservation {
 public:
  /// Starts a frame. Forgets detections older than `remembered_frames`, in A and in the counts of `map`.
  void begin_frame(int remembered_frames, VoxelMap& map);

  /// Records one detection: its voxels, each once, in A and in the counts of `map`.
  void record(MarkingType type, MarkingStyle style, std::vector<VoxelId> voxels, VoxelMap& map);

  /// Forgets a voxel that left the map, so that its slot may be used again.
  void erase(VoxelId id);

  /// The row of A that belongs to a voxel: every living voxel that was seen with it, itself left out, in a
  /// deterministic order. The reference holds until the next call.
  const std::vector<CoObserved>& row(VoxelId id);

  std::uint64_t frame() const { return frame_; }
  /// Number of entries that are stored, for tests and benchmarks of the memory's bound.
  std::size_t stored_entries() const;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(frame_, first_, observations_, seen_in_, born_);
  }

 private:
  using ObservationId = std::uint64_t;  ///< counts up by one per recorded detection

  /// A remembered detection.
  struct Observation {
    std::uint64_t frame = 0;  ///< number of the frame that it belongs to
    MarkingType type = MarkingType::laneline;
    MarkingStyle style = MarkingStyle::unknown;
    std::vector<VoxelId> voxels;
    template <class Archive>
    void serialize(Archive& archive) {
      archive(frame, type, style, voxels);
    }
  };

  ObservationId next() const { return first_ + observations_.size(); }
  /// Whether a detection touched the present voxel of a slot, and not a former one.
  bool has_seen(VoxelId voxel, ObservationId observation) const { return observation >= born_[voxel]; }
  void append(VoxelId voxel, ObservationId observation);

  std::uint64_t frame_ = 0;
  ObservationId first_ = 0;  ///< the oldest detection that is remembered
  std::deque<Observation> observations_;
  std::vector<std::vector<ObservationId>> seen_in_;  ///< per voxel, ascending; may begin with forgotten ones
  std::vector<ObservationId> born_;                  ///< per voxel: the first detection that touched it

  std::vector<std::uint32_t> counts_;  ///< scratch of row(), all zero in between
  std::vector<CoObserved> row_;
};

}  // namespace laneloom::voxels
