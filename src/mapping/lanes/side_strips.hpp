#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/reasons.hpp"
#include "laneloom/types.hpp"
#include "mapping/geometry/scene.hpp"
#include "mapping/lanes/lane_layout.hpp"
#include "mapping/lanes/lane_tracks.hpp"
#include "mapping/markings/id_source.hpp"

namespace laneloom::lanes {

/// The strips at the side of the road as state: shoulders, parking strips, cycle lanes. They are followed as
/// lanes are, by tracks of their own, and give way to lanes. No lane is linked with them. Ours.
class SideStrips {
 public:
  /// Takes in the strips of a layout whose lanes are those of the map, and gives it the strips of the map in
  /// their place, by ascending id. Adds to `reasons`, which may be null.
  void update(const geometry::Scene& scene, const LaneConfig& config, markings::IdSource& ids,
              LaneLayout& layout, FrameReasons* reasons);

  /// Moves all of them, map frame.
  void move(const Eigen::Isometry3d& motion) { tracks_.move(motion); }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(tracks_);
  }

 private:
  LaneTracks tracks_;
};

}  // namespace laneloom::lanes
