#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "laneloom/types.hpp"

namespace laneloom::drive {

/// The support of a stretch of a plan.
enum class Support : std::uint8_t {
  mapped,      ///< the present map gives the way
  remembered,  ///< an earlier map gave it
  guessed      ///< no map gave it: it continues the way before
};

/// The path that the vehicle plans to take.
struct Plan {
  Polyline path;                 ///< map frame, from a little behind the vehicle on; empty: no plan yet
  std::vector<Support> support;  ///< per point
  std::optional<Way> way;        ///< of the last map that had one
  bool looks_for_turn = false;   ///< the lane ends soon, and the wished turn is not yet in the map

  /// The support at the point nearest to a place; guessed if the plan is empty.
  Support support_at(const Point& place) const;
};

/// What leads a plan.
struct Guide {
  WayWish wish = WayWish::straight;
  /// The way of the map, which fulfils the wish, rather than one of the plan's own.
  bool by_published_way = false;
};

/// Plans the path of the vehicle on a map: along the way that the map has from where the previous plan leads.
///
/// The plan begins beside the vehicle as the previous one, and bends to the way smoothly. If the map gives no
/// way, the previous plan stays where it is in the map frame, and is prolonged with a curvature that fades.
/// Pure.
Plan next_plan(const LocalMap& map, const Eigen::Isometry3d& T_map_body, double speed_mps,
               const Plan& previous, const Guide& guide);

}  // namespace laneloom::drive
