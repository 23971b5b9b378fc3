#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "mapping/boundaries/lane_boundaries.hpp"
#include "mapping/geometry/scene.hpp"
#include "mapping/lanes/inferred_boundaries.hpp"
#include "mapping/lanes/known_lines.hpp"
#include "mapping/lanes/lane_layout.hpp"
#include "mapping/markings/id_source.hpp"

namespace laneloom::lanes {

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

  /// Moves all of them, map frame.
  void move(const Eigen::Isometry3d& motion) { known_.move(motion); }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(known_);
  }

 private:
  void identify(const std::vector<Marking*>& inferred, const geometry::Scene& scene, markings::IdSource& ids);

  KnownLines known_;
};

}  // namespace laneloom::lanes
