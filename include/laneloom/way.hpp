#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "laneloom/lane_graph.hpp"
#include "laneloom/types.hpp"

/// Makes ways (way_types.hpp). Everything here is pure, the same to the last bit on every host, and may be
/// used by several threads at once.
namespace laneloom {

struct WayOptions {
  double reach_m = 60.0;  ///< greatest length; more than `step_m`
  double step_m = 1.0;    ///< between stations; more than 0
  /// The range ahead of the vehicle within which the lane ends from which the wished turn is made. The first
  /// of several such lanes is taken, or a branch that forks off to that side if no lane turns within the
  /// range. Empty: the next turn that the map allows is made.
  std::optional<Stretch> turn_m = {};
};

/// The way ahead of the vehicle. `before` is the way before, or null. The way keeps to the lanes of the way
/// before where lanes fork or overlap, as long as the map has them and they fit the wish as well as others
/// do; a change of lanes goes on while the wish stays. Where the lanes end, the way goes on along a driven
/// path that runs on as the wish says, or straight on where the map's own way goes along a street of the SD
/// map. A vehicle that is neither in a lane nor on a passage goes on along the way before; off that way, it
/// goes into a lane that begins straight ahead, at most 20 m away. A way ends before a corner of a radius
/// below 2.5 m, because such a corner is an error of the map. Empty: none of these leads on.
std::optional<Way> way_ahead(const LaneGraph& graph, const Eigen::Isometry3d& T_map_body, WayWish wish,
                             const Way* before = nullptr, const WayOptions& options = {});

}  // namespace laneloom
