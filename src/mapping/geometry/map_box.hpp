#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"

namespace laneloom::geometry {

/// The box around the vehicle that is mapped (paper, Sec. IV-C). Any height is inside.
class MapBox {
 public:
  MapBox(const RangeConfig& config, const Eigen::Isometry3d& T_map_body);

  /// Whether a point lies in the box or its margin, where evidence is gathered.
  bool keeps(const Point& point_map) const;

  /// Whether a point lies in the box itself.
  bool shows(const Point& point_map) const;

  const Eigen::Isometry3d& T_map_body() const { return T_map_body_; }

  /// The stretches of a polyline that lie in the box, by arc length, in order. The line has at least two
  /// points.
  std::vector<Stretch> inside(const Polyline& line_map) const;

 private:
  Eigen::Isometry3d T_map_body_, T_body_map_;
  Eigen::AlignedBox2d box_;   ///< body frame
  Eigen::AlignedBox2d kept_;  ///< body frame, with the margin
};

}  // namespace laneloom::geometry
