#pragma once

#include "simulation/road.hpp"

/// What every source of roads does with the lines that it has found.
namespace laneloom {

/// How much of lines a road may have: a few bytes can name lines that would, sampled, take all memory.
class LengthLimit {
 public:
  static constexpr const char* kComplaint = "is beyond 300 km of lines, which is the most for a road";

  /// False: it is too much.
  bool add(const Polyline& line);

 private:
  double total_m_ = 0.0;
};

/// The line midway between two borders that run side by side, with a point every `step_m` or less.
Polyline midway(const Polyline& left, const Polyline& right, double step_m = 1.0);

/// Joins markings of one type and style that continue one another: whose ends are closer than `tolerance_m`,
/// with no third end there, and point the same way. Closed lines become rings. Ids are given anew, and the
/// lanes refer to the joined markings.
void join_markings(Road& road, double tolerance_m);

/// Borders without a marking that run along a roadedge (closer than `tolerance_m`, over four fifths of their
/// length) are given it.
void attach_roadedges(Road& road, double tolerance_m);

}  // namespace laneloom
