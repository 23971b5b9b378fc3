#pragma once

#include <cstdint>
#include <vector>

#include "laneloom/types.hpp"
#include "mapping/geometry/scene.hpp"
#include "mapping/markings/id_source.hpp"

namespace laneloom::lanes {

/// The name of a line, and since when it is known.
struct LineIdentity {
  ElementId id = kNoElement;
  std::int64_t first_seen_ns = 0;
};

/// A line that was published, kept to recognise it in later frames.
struct KnownLine : LineIdentity {
  Polyline points;               ///< map frame, as it was last found
  std::uint64_t last_frame = 0;  ///< number of the frame that last found it

  template <class Archive>
  void serialize(Archive& archive) {
    archive(id, first_seen_ns, points, last_frame);
  }
};

/// Recognises lines that are found anew in every frame.
class KnownLines {
 public:
  /// Per found line, the identity of the known line that it covers most of, or else a new one. A known line
  /// that was recognised in the same frame is left out.
  std::vector<LineIdentity> identify(const std::vector<const Polyline*>& found, const geometry::Scene& scene,
                                     markings::IdSource& ids);
  /// Forgets the lines that were not found for longer than `memory_frames`.
  void forget(const geometry::Scene& scene, int memory_frames);

  /// Moves all of them, map frame.
  void move(const Eigen::Isometry3d& motion) {
    for (KnownLine& known : lines_)
      for (Point& point : known.points) point = motion * point;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(lines_);
  }

 private:
  std::vector<KnownLine> lines_;
};

}  // namespace laneloom::lanes
