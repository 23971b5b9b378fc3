#pragma once

#include <vector>

#include "drive/bicycle.hpp"
#include "laneloom/polyline.hpp"
#include "simulation/road.hpp"

namespace laneloom::drive {

/// Follows a vehicle through the true lanes of a road, and tells whether it keeps to them. Where lanes fork
/// it may be in several at once.
class LaneTracker {
 public:
  enum class Verdict : std::uint8_t {
    in_lane,
    road_ended,    ///< its lane ends, and no other lane goes on beside it
    changed_lane,  ///< it is in another lane of its direction, though its own goes on
    oncoming,      ///< it is in a lane of another direction
    off_lanes      ///< it is in no lane
  };

  /// `road` must outlive this, and have lanes.
  explicit LaneTracker(const simulation::Road& road);

  /// Puts the vehicle into a lane.
  void place(std::size_t lane) { lanes_ = {lane}; }
  /// Moves the vehicle's centre to `centre`. From a lane it may go to its successors and, where the lane
  /// ends, also to one beside it that goes on. When it leaves its lanes, lanes() stays unchanged.
  Verdict move_to(const Eigen::Vector2d& centre, const Eigen::Vector2d& direction);

  /// Indices of the lanes that the vehicle may be in; never empty after place().
  const std::vector<std::size_t>& lanes() const { return lanes_; }
  /// Offset to the left of the nearest centerline of its lanes, in metres.
  double offset_m() const { return offset_m_; }
  /// Width of that lane beside the vehicle, in metres.
  double width_m() const { return width_m_; }
  bool in_intersection() const;

  /// T_map_body of a vehicle whose rear axle is on the road's surface. Across the road, the surface is level.
  Eigen::Isometry3d on_surface(const Bicycle& vehicle) const;
  const MeasuredPolyline& centerline(std::size_t lane) const { return lines_[lane].centre; }
  /// Per lane, the indices of the lanes that follow it.
  const std::vector<std::vector<std::size_t>>& successors() const { return successors_; }

 private:
  struct Lines {
    MeasuredPolyline centre, left, right;
  };
  struct Place {
    Projection foot;
    double width_m = 0.0;
    bool inside = false;
  };
  Place place_in(std::size_t lane, const Eigen::Vector2d& centre) const;
  bool goes_on(std::size_t lane, double from_m, double for_m, int depth = 0) const;
  std::vector<std::size_t> within_reach() const;
  std::vector<std::size_t> aligned_lanes(const Eigen::Vector2d& centre, const Eigen::Vector2d& direction,
                                         double within_m) const;
  bool own_ends(const Eigen::Vector2d& centre, double within_m) const;
  bool settle(const std::vector<std::size_t>& candidates, const Eigen::Vector2d& centre);

  const simulation::Road& road_;
  std::vector<Lines> lines_;
  std::vector<std::vector<std::size_t>> successors_;
  std::vector<std::size_t> lanes_;
  double offset_m_ = 0.0, width_m_ = 0.0;
};

}  // namespace laneloom::drive
