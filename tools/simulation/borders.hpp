#pragma once

#include "simulation/road.hpp"

/// Functions of all sources of roads for the lines that they found.
namespace laneloom::simulation {

/// Limits the length of a road's lines: a few bytes can name lines that would take all memory once they are
/// sampled.
class LengthLimit {
 public:
  static constexpr const char* kComplaint = "is beyond 300 km of lines, which is the most for a road";

  /// Adds a line. False: the lines are too long.
  bool add(const Polyline& line);

 private:
  double total_m_ = 0.0;
};

/// The line midway between two borders that run side by side, with a point every `step_m` or less.
Polyline midway(const Polyline& left, const Polyline& right, double step_m = 1.0);

/// Whether the road has lanelines or roadedges, so that a network sees anything of its lanes.
bool has_lines(const Road& road);

/// Joins markings of one type and style that continue one another: their ends are closer than `tolerance_m`,
/// with no third end there, and point the same way. Closed lines become rings. Ids are given anew, and the
/// lanes refer to the joined markings.
void join_markings(Road& road, double tolerance_m);

/// Gives borders without a marking the one of a type that they run along (closer than `tolerance_m`, over
/// four fifths of their length).
void attach_markings(Road& road, MarkingType type, double tolerance_m);

}  // namespace laneloom::simulation
