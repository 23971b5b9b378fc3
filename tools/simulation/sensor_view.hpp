#pragma once

#include <vector>

#include "laneloom/polyline.hpp"
#include "simulation/road.hpp"

/// The parts of a road that are before the sensors.
namespace laneloom::simulation {

/// A box in the body frame. It is flat, so that a road above or below another is not seen from there.
struct SensorView {
  double forward_min_m = -40.0;
  double forward_max_m = 50.0;
  double side_max_m = 20.0;
  double height_max_m = 3.0;
  std::vector<MarkingType> detected_types;  ///< types that the network can detect; empty: every type

  Polyline polygon() const;  ///< body frame, counter-clockwise
  bool detects(MarkingType type) const;
  Eigen::AlignedBox3d box() const;
};

/// A line in the map, prepared for repeated views.
struct ViewedLine {
  explicit ViewedLine(const Polyline& points);
  bool may_be_near(const Point& position, double distance_m) const;

  MeasuredPolyline line;
  Point centre = Point::Zero();
  double radius_m = 0.0;
  bool ring = false;
};

/// A piece of a line in view.
struct VisiblePiece {
  Stretch arc;      ///< on the line; a piece over the seam of a ring begins below 0
  Polyline points;  ///< body frame
};

/// The pieces of a line that are in view and not too short to be detected (1 m), in their order along the
/// line.
std::vector<VisiblePiece> visible_pieces(const ViewedLine& line, const SensorView& view,
                                         const Eigen::Isometry3d& T_body_map);

}  // namespace laneloom::simulation
