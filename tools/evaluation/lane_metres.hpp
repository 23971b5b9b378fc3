#pragma once

#include <array>
#include <cstdint>

#include "laneloom/config.hpp"
#include "mapping/geometry/point_grid.hpp"
#include "simulation/road.hpp"

/// The quality of lanes by the metre, so that a long wrong lane counts for more than a short one.
///
/// The centerlines of the published lanes, but for strips at the side of the road, are sampled every 0.5 m
/// within the range box. A sample is, in this order:
/// - right: less than 0.5 m from the centerline of a truth lane, in intersections as well;
/// - straddling: less than 1 m from a laneline of the truth, so that the line runs through the lane;
/// - offset: within a truth lane, but too far from its middle;
/// - beside an edge: in no truth lane, and less than 3 m from a roadedge, be it beyond or on a strip;
/// - elsewhere.
/// Directions: of the right samples, those whose lane tells its direction, and those of them that run with
/// the traffic of a truth lane there. A lane that is driven both ways runs with any.
///
/// Shoulders: their samples likewise, and those in no truth lane.
///
/// Driven paths: their samples likewise, and those less than 0.9 m and 1.5 m from the middle of a truth lane
/// whose traffic runs that way (at less than 45 degrees).
namespace laneloom::evaluation {

enum class LaneClass : std::uint8_t { right, straddling, offset, beside_edge, elsewhere };
inline constexpr std::size_t kLaneClassCount = 5;

/// Lengths of published lanes, summed over frames.
struct LaneMetres {
  std::array<double, kLaneClassCount> by_class_m{};
  double told_m = 0.0;                               ///< part of the right metres that tells a direction
  double told_right_m = 0.0;                         ///< part of these that runs with the traffic
  double shoulder_m = 0.0;                           ///< of shoulders and parking strips
  double shoulder_outside_m = 0.0;                   ///< part of these in no truth lane
  double driven_m = 0.0;                             ///< of driven paths
  double driven_near_m = 0.0, driven_there_m = 0.0;  ///< parts of these less than 0.9 m and 1.5 m aside
  double driven_belief_m = 0.0;  ///< as many of them should be there, by their probabilities

  double of(LaneClass lane_class) const { return by_class_m[static_cast<std::size_t>(lane_class)]; }
  double published_m() const;
  LaneMetres& operator+=(const LaneMetres& other);
};

/// Not thread-safe.
class LaneMetresMeter {
 public:
  LaneMetresMeter(const simulation::Road& truth, const RangeConfig& range);
  void add(const LocalMap& map);
  const LaneMetres& metres() const { return metres_; }

 private:
  enum class Of : std::uint8_t { lane, laneline, roadedge };
  struct Sample {
    Point position;
    Eigen::Vector2d direction;
    Of of;
    double half_width_m;  ///< of the lane
  };
  static void sample(const Polyline& line, Of of, double width_m, std::vector<Sample>& samples);
  void add_sample(const Point& point, const Eigen::Vector2d& direction, Lane::Direction told);
  void add_shoulder(const Point& point);
  void add_driven(const Point& point, const Eigen::Vector2d& direction, double probability);

  RangeConfig range_;
  geometry::PointGrid<Sample> truth_;
  LaneMetres metres_;
};

}  // namespace laneloom::evaluation
