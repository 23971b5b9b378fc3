#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "mapping/geometry/scene.hpp"
#include "mapping/lanes/inferred_boundaries.hpp"
#include "mapping/lanes/lane_layout.hpp"
#include "mapping/markings/id_source.hpp"

namespace laneloom::lanes {

/// A lane that was published, kept to recognise it in later frames.
struct KnownLane {
  ElementId id = kNoElement;
  ElementId boundary_a = kNoElement;  ///< the smaller of the two ids
  ElementId boundary_b = kNoElement;
  Polyline centerline;              ///< map frame, as it was last found; once published, as it runs there
  std::uint64_t last_frame = 0;     ///< number of the frame that last found it
  double direction_log_odds = 0.0;  ///< that traffic runs along the centerline
  int kept_direction = 0;           ///< 1: traffic was sure to run along it; -1: against it; 0: neither
  double belief = 0.0;              ///< log odds of its direction, smoothed over frames
  int told_direction = 0;           ///< 1, -1: the last map told that it runs so; 0: it told no direction
  int published = 0;                ///< 1: the last map's lane ran along it; -1: against it; 0: a new lane
  bool driven = false;              ///< by the vehicle
  template <class Archive>
  void serialize(Archive& archive) {
    archive(id, boundary_a, boundary_b, centerline, last_frame, direction_log_odds, kept_direction, belief,
            told_direction, published, driven);
  }
};

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

/// Recognises lanes and inferred boundaries, which are found anew in every frame. Those that were not found
/// for a while are forgotten.
class LaneMemory {
 public:
  LaneMemory() = default;
  explicit LaneMemory(std::vector<KnownLane> lanes) : lanes_(std::move(lanes)) {}

  /// Gives the inferred boundaries their ids, then all lanes, also those beside inferred boundaries. Returns
  /// them with the lanes' neighbours. Forgets the inferred boundaries that were not found for a while: call
  /// it last in a frame.
  LaneLayout recognise(FoundLanes found, const geometry::Scene& scene, const LaneConfig& config,
                       markings::IdSource& ids);

  /// Gives inferred markings their ids, and makes boundaries of them that lanes can lie beside.
  std::vector<boundaries::LaneBoundary> recognise(std::vector<Marking> inferred, const geometry::Scene& scene,
                                                  markings::IdSource& ids);

  /// Gives every inferred boundary the id of the known boundary that it covers most of, or else a new id. A
  /// known boundary that was recognised in the same frame is left out.
  void identify(const std::vector<Marking*>& inferred, const geometry::Scene& scene, markings::IdSource& ids);
  /// Gives every lane the id of the known lane that it covers most of, or else a new id. Known lanes between
  /// the same boundaries come first. The known lane takes over the lane's present shape. Sorts the lanes by
  /// their ids.
  void identify(std::vector<Lane>& lanes, const geometry::Scene& scene, const LaneConfig& config,
                markings::IdSource& ids);

  const std::vector<KnownLane>& lanes() const { return lanes_; }
  /// The known lane of an id. Null: there is none.
  const KnownLane* find(ElementId lane) const;
  KnownLane* find(ElementId lane);

  /// Remembers how each lane runs in the map. A lane whose id was published running the other way is another
  /// lane from now on: it gets a new id. Returns the former and the new id of each of these.
  std::map<ElementId, ElementId> publish(const std::vector<Lane>& lanes, markings::IdSource& ids);

  template <class Archive>
  void serialize(Archive& archive) {
    archive(lanes_, inferred_);
  }

 private:
  std::vector<KnownLane> lanes_;
  std::vector<KnownInferred> inferred_;
};

}  // namespace laneloom::lanes
