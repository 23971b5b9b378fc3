#pragma once

#include <cstdint>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "mapping/boundaries/lane_boundaries.hpp"
#include "mapping/geometry/scene.hpp"
#include "mapping/lanes/inferred_boundaries.hpp"
#include "mapping/lanes/lane_layout.hpp"
#include "mapping/markings/id_source.hpp"

namespace laneloom::lanes {

/// An inferred boundary that was published, kept to recognise it in later frames.
struct KnownInferred {
  ElementId id = kNoElement;
  std::int64_t first_seen_ns = 0;
  Polyline points;               ///< map frame, as it was last found
  std::uint64_t last_frame = 0;  ///< number of the frame that last found it
  template <class Archive>
  void serialize(Archive& archive) {
    archive(id, first_seen_ns, points, last_frame);
  }
};

/// Recognises inferred boundaries, which are found anew in every frame. Those that were not found for a while
/// are forgotten.
class InferredMemory {
 public:
  /// Gives the inferred boundaries their ids, and lays out the lanes beside them with the others. Forgets the
  /// inferred boundaries that were not found for a while: call it last in a frame.
  LaneLayout recognise(FoundLanes found, const geometry::Scene& scene, const LaneConfig& config,
                       markings::IdSource& ids);

  /// Gives inferred markings their ids, and makes boundaries of them that lanes can lie beside.
  std::vector<boundaries::LaneBoundary> recognise(std::vector<Marking> inferred, const geometry::Scene& scene,
                                                  markings::IdSource& ids);

  /// Gives every inferred boundary the id of the known boundary that it covers most of, or else a new id. A
  /// known boundary that was recognised in the same frame is left out.
  void identify(const std::vector<Marking*>& inferred, const geometry::Scene& scene, markings::IdSource& ids);

  /// Moves all of them, map frame.
  void move(const Eigen::Isometry3d& motion) {
    for (KnownInferred& known : inferred_)
      for (Point& point : known.points) point = motion * point;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(inferred_);
  }

 private:
  std::vector<KnownInferred> inferred_;
};

}  // namespace laneloom::lanes
