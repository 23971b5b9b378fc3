#pragma once

#include <cstddef>
#include <vector>

#include "export/road_network.hpp"

namespace laneloom::exports {

/// A place on a reference line, and the lanes there.
struct CrossSection {
  Point place;                   ///< on the reference line, map frame
  double heading_rad = 0.0;      ///< of the line
  double along_m = 0.0;          ///< from the begin of the line
  std::vector<double> widths_m;  ///< of the lanes, from left to right
};

/// The curve from one cross-section to the next one, in the frame of the first: of the third degree, with the
/// headings of both.
struct Curve {
  Eigen::Vector2d b, c, d;  ///< b p + c p² + d p³; p from 0 to 1
  double length_m = 0.0;
};

/// Lanelets beside each other that are driven in one direction, come from one road and lead to one. The
/// reference line is the left border of the leftmost one.
struct Carriageway {
  std::vector<std::size_t> lanelets;         ///< from left to right
  std::vector<CrossSection> cross_sections;  ///< two or more
  std::vector<Curve> curves;                 ///< one less

  double length_m() const { return cross_sections.back().along_m; }
};

/// All lanelets of a network, each in one carriageway. Lanelets without length are left out.
std::vector<Carriageway> carriageways(const RoadNetwork& network);

}  // namespace laneloom::exports
