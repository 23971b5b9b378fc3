#pragma once

#include <cstddef>
#include <optional>

#include "laneloom/way.hpp"
#include "mapping/lanes/lane_changes.hpp"

namespace laneloom::lanes {

/// Walks along a line and knows the vertex nearest to the walker. Each step costs little.
class NearestVertex {
 public:
  /// `line` must outlive this.
  explicit NearestVertex(const Polyline& line) : line_(line) {}

  /// The index of the vertex of a line that has one.
  std::size_t at(const Point& place);
  /// How far the line is to the left of a place, along the normal of a direction. Empty: it does not pass.
  std::optional<double> left_of(const Point& place, const Eigen::Vector2d& direction);

 private:
  const Polyline& line_;
  std::optional<std::size_t> nearest_;
};

/// What a way tells of one lane, at stations that follow one another.
class LaneMeasures {
 public:
  /// `graph` must outlive this.
  LaneMeasures(const LaneGraph& graph, const DirectedLane& lane);

  /// Fills in what the lane is at a station with a point and a direction, `arc_m` along the lane as it is
  /// walked.
  void fill(double arc_m, WayStation& station);

 private:
  struct Border {
    NearestVertex line;
    const Marking* boundary;  // null: it has no deviations
    NearestVertex vertices;   // of the boundary
  };
  Border border(const LocalMap& map, Side side) const;
  static std::optional<double> variance_m2(Border& border, const Point& place);

  DirectedLane lane_;
  double length_m_;
  LaneChanges changes_;
  Border left_, right_;  // as the lane is walked
};

}  // namespace laneloom::lanes
