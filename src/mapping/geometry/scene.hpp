#pragma once

#include <cstdint>
#include <span>

#include "mapping/geometry/map_box.hpp"

namespace laneloom::geometry {

/// The place and time of the map: those of the newest frame so far, which may be newer than the frame that is
/// fused.
struct Scene {
  MapBox box;                       ///< about the vehicle
  std::int64_t stamp_ns = 0;        ///< of the newest frame
  std::uint64_t frame = 0;          ///< counts the fused frames
  std::span<const Point> driven{};  ///< places that the vehicle came through, map frame

  const Eigen::Isometry3d& T_map_body() const { return box.T_map_body(); }
};

}  // namespace laneloom::geometry
