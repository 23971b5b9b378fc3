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

  /// Fills in what the lane is at a station that has a point and this direction, `arc_m` along the lane as it
  /// is walked.
  void fill(double arc_m, const Eigen::Vector2d& direction, WayStation& station);

 private:
  /// A side of the lane, and the boundary there, which is followed until another one takes its place.
  struct Followed {
    Side side;  // as the lane's points run
    NearestVertex line;
    const Border* border = nullptr;
    const Marking* boundary = nullptr;      // null: it is unseen, or has no deviations
    std::optional<NearestVertex> vertices;  // of the boundary
  };
  Followed followed(Side side) const;
  void follow(double at_m, Followed& side) const;
  std::optional<double> variance_m2(double at_m, const Point& place, Followed& side) const;

  DirectedLane lane_;
  double length_m_;
  LaneChanges changes_;
  const std::vector<Marking>& boundaries_;
  Followed left_, right_;  // as the lane is walked
};

}  // namespace laneloom::lanes
