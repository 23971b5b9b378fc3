#pragma once

#include <vector>

#include "laneloom/types.hpp"
#include "mapping/geometry/point_grid.hpp"

namespace laneloom {

/// Tells how well the detections of a frame fit a map from any pose of the vehicle.
class MapFit {
 public:
  /// `near` is about where the vehicle is.
  MapFit(const DetectionFrame& frame, const std::vector<Marking>& markings, const Eigen::Isometry3d& near);

  /// The length of the detections, in metres, that is near enough to tell.
  double length_m() const { return step_m_ * static_cast<double>(samples_.size()); }
  /// The length of the detections, in metres, that lie on markings if they are seen from `T_map_body`. What
  /// lies beside a marking counts less.
  double explained_m(const Eigen::Isometry3d& T_map_body) const;
  /// The pose nearby from which the detections fit best. It stays where they do not tell.
  Eigen::Isometry3d refined(Eigen::Isometry3d T_map_body) const;

 private:
  /// A place on a marking, or on a detection.
  struct Place {
    Point position = Point::Zero();
    Eigen::Vector2d direction = Eigen::Vector2d::UnitX();
    bool is_stopline = false;
  };
  /// A sample of a detection beside the place of a marking that is nearest to it.
  struct Beside {
    Eigen::Vector2d normal;  ///< to the left of the marking
    double lateral_m;        ///< of the sample, to the left of the marking
  };
  static std::vector<Place> places(const Polyline& line, MarkingType type, double step_m);
  static const Place* nearest(const geometry::PointGrid<Place>& grid, const Place& sample);
  template <class Visit>
  void each_beside(const Eigen::Isometry3d& T_map_body, Visit&& visit) const;

  std::vector<Place> samples_;  ///< of the detections, body frame
  double step_m_ = 1.0;         ///< between samples
  geometry::PointGrid<Place> map_;
};

}  // namespace laneloom
