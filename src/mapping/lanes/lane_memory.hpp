#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "mapping/geometry/scene.hpp"
#include "mapping/lanes/inferred_boundaries.hpp"
#include "mapping/lanes/lane_layout.hpp"
#include "mapping/markings/id_source.hpp"

namespace laneloom {

/// A lane that was published, for recognising it.
struct KnownLane {
  ElementId id = kNoElement;
  ElementId boundary_a = kNoElement;  ///< the smaller of the two
  ElementId boundary_b = kNoElement;
  Polyline centerline;
  std::uint64_t last_frame = 0;
  double direction_log_odds = 0.0;  ///< evidence that traffic runs along the centerline
  int kept_direction = 0;           ///< 1: it is sure to, -1: it is sure to run against it
  template <class Archive>
  void serialize(Archive& archive) {
    archive(id, boundary_a, boundary_b, centerline, last_frame, direction_log_odds, kept_direction);
  }
};

/// An inferred boundary that was published, for recognising it.
struct KnownInferred {
  ElementId id = kNoElement;
  std::int64_t first_seen_ns = 0;
  Polyline points;
  std::uint64_t last_frame = 0;
  template <class Archive>
  void serialize(Archive& archive) {
    archive(id, first_seen_ns, points, last_frame);
  }
};

/// Recognises lanes and inferred boundaries, which are found anew in every frame. What was not seen for a
/// while is forgotten.
class LaneMemory {
 public:
  LaneMemory() = default;
  explicit LaneMemory(std::vector<KnownLane> lanes) : lanes_(std::move(lanes)) {}

  /// What was found, by its ids: first the inferred boundaries, then the lanes, those beside inferred
  /// boundaries too; each lane with its neighbours.
  LaneLayout recognise(FoundLanes found, const Scene& scene, const LaneConfig& config, IdSource& ids);

  /// Gives every boundary the id of the known one that it covers most of, else a new one.
  void identify(std::vector<InferredBoundary>& inferred, const Scene& scene, const LaneConfig& config,
                IdSource& ids);
  /// Gives every lane the id of the known lane that it covers most of, a lane of the same boundaries first;
  /// else a new one. The known lane then is as the lane now is. Sorts the lanes by their ids.
  void identify(std::vector<Lane>& lanes, const Scene& scene, const LaneConfig& config, IdSource& ids);

  const std::vector<KnownLane>& lanes() const { return lanes_; }
  const std::vector<KnownInferred>& inferred() const { return inferred_; }
  /// Null: there is none of that id.
  const KnownLane* find(ElementId lane) const;
  KnownLane* find(ElementId lane);

  template <class Archive>
  void serialize(Archive& archive) {
    archive(lanes_, inferred_);
  }

 private:
  std::vector<KnownLane> lanes_;
  std::vector<KnownInferred> inferred_;
};

}  // namespace laneloom
