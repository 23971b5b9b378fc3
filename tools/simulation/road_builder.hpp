#pragma once

#include <string>
#include <utility>
#include <vector>

#include "simulation/alignment.hpp"
#include "simulation/road.hpp"

/// Building blocks of made-up roads: streets with a cross-section, and intersections between them.
/// Right-hand traffic.
namespace laneloom::simulation {

inline constexpr double kLaneWidth_m = 3.5;
inline constexpr double kCornerRadius_m = 8.0;  // of the edges of an intersection

/// A change in the number of lanes: from `at_m` on, a side has `lanes` lanes. Over a taper its edge moves
/// outwards or inwards, and the new (or ending) lane is beside the edge. Without a taper another street takes
/// the lane away or brings it: the edge jumps, and the lane's border is painted solid along the gore on the
/// side that has fewer lanes.
struct LaneChange {
  double at_m = 0.0;
  int lanes = 1;
  double taper_m = 30.0;
  double gore_m = 15.0;
};

/// The lanes of one direction, and how their number changes along the reference line (whichever direction is
/// driven), in ascending order of `at_m`.
struct RoadHalf {
  int lanes = 1;
  std::vector<LaneChange> changes{};
};

enum class CentreLine { none, dashed, solid, double_solid };

/// Cross-section of a street: its reference line is between the directions. Edges are roadedges, and borders
/// between lanes of one direction are dashed unless said to be solid.
struct Section {
  RoadHalf forward{};
  RoadHalf backward{.lanes = 0, .changes = {}};  ///< 0: one-way, and the reference line is the left edge
  CentreLine centre = CentreLine::solid;
  double lane_width_m = kLaneWidth_m;
  int solid_after = 0;        ///< the border after so many lanes from the reference line is solid; 0: none
  double shoulder_m = 0.0;    ///< below 2.5; from a solid line to the edge, where no lane begins or ends
  bool visible_edges = true;  ///< else the street ends in grass
  double gore_begin_m = 0.0;  ///< a one-way street's left edge is painted solid up to here (an exit)
  double gore_end_m = 0.0;    ///< likewise over this last length (an entry)
};
Section two_way(int forward, int backward, CentreLine centre);
/// The distance from the reference line to the outer border of `lanes` lanes.
double half_width_m(int lanes, CentreLine centre, double lane_width_m = kLaneWidth_m);

/// The mouth of a street at an intersection. `outward` is the end of its reference line there, heading away
/// from the intersection.
struct Mouth {
  Frame outward;
  int leaving = 1;   ///< number of lanes away from the intersection
  int arriving = 1;  ///< number of lanes towards it
  CentreLine centre = CentreLine::solid;
  double lane_width_m = kLaneWidth_m;
};

Mouth mouth_at_start(const Alignment& alignment, const Section& section);
Mouth mouth_at_end(const Alignment& alignment, const Section& section);

/// Builds a road from streets and intersections. Not thread-safe.
class RoadBuilder {
 public:
  explicit RoadBuilder(std::string name) { road_.name = std::move(name); }

  /// Adds the markings and lanes of a street.
  void add_street(const Alignment& alignment, const Section& section);

  /// Adds an intersection between mouths (given counter-clockwise): edges round its corners, stoplines where
  /// `stoplines`, and the lanes across it: straight on, left from the leftmost and right from the rightmost
  /// lane.
  void add_intersection(const std::vector<Mouth>& mouths, bool stoplines = true);

  /// Joins markings, finds successors, and drives through the lanes nearest to the `waypoints`, in order.
  /// Throws std::logic_error if no way leads from one waypoint to the next.
  Road build(const Polyline& waypoints, double speed_mps) &&;

 private:
  ElementId add_marking(MarkingType type, MarkingStyle style, Polyline points);
  void add_crossing(const Mouth& from, int from_lane, const Mouth& to, int to_lane);

  Road road_;
};

}  // namespace laneloom::simulation
