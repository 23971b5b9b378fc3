#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/reasons.hpp"
#include "mapping/geometry/scene.hpp"
#include "mapping/lanes/hypotheses.hpp"
#include "mapping/lanes/lane_layout.hpp"
#include "mapping/lanes/lane_track.hpp"
#include "mapping/markings/id_source.hpp"

namespace laneloom::lanes {

/// The lanes of the map as state. The lanes that a frame finds are observations of them: the evidence that a
/// lane is there grows where it is found, and falls where it is not. A lane is shown from a threshold on,
/// until its evidence falls below a lower one. It keeps its id, its orientation and its course meanwhile.
class LaneTracks {
 public:
  LaneTracks() = default;
  explicit LaneTracks(std::vector<LaneTrack> tracks) : tracks_(std::move(tracks)) {}

  /// Takes in the lanes that a frame found. Returns the layout with the lanes of the tracks, by ascending id,
  /// and their neighbours, in place of these. `reasons` may be null.
  LaneLayout update(LaneLayout found, const geometry::Scene& scene, const LaneConfig& config,
                    markings::IdSource& ids, FrameReasons* reasons = nullptr);

  /// Takes the lanes that were found as they are, for a map that is made at once.
  LaneLayout adopt(LaneLayout found, markings::IdSource& ids);

  /// Forgets the lanes at the places for which `is_gone` holds, map frame.
  void forget(const std::function<bool(const Point&)>& is_gone);
  /// Moves all of them, map frame.
  void move(const Eigen::Isometry3d& motion);

  const std::vector<LaneTrack>& all() const { return tracks_; }
  /// The boundaries on the left and on the right of lanes that the last map showed, as the boundaries' road
  /// runs.
  KnownBorders known_borders() const;
  /// The track of an id. Null: there is none.
  const LaneTrack* find(ElementId id) const;
  LaneTrack* find(ElementId id);

  /// Remembers how each lane runs in the map. A lane whose id was published running the other way is another
  /// lane from now on: it gets a new id. Returns the former and the new id of each of these.
  std::map<ElementId, ElementId> publish(const std::vector<Lane>& lanes, markings::IdSource& ids);

  template <class Archive>
  void serialize(Archive& archive) {
    archive(tracks_);
  }

 private:
  std::vector<LaneTrack> tracks_;  ///< by ascending id
};

}  // namespace laneloom::lanes
