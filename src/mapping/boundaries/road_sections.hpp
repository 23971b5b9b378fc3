#pragma once

#include <cstddef>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/polyline.hpp"
#include "mapping/boundaries/lane_boundaries.hpp"

namespace laneloom::boundaries {

/// How another boundary lies beside a given one, over the stretch that they have in common.
struct SideBySide {
  std::size_t other = 0;   ///< index of the other boundary
  double lateral_m = 0.0;  ///< mean distance; positive: the other lies on the left of the given one
  double length_m = 0.0;   ///< of that stretch
  bool opposed = false;    ///< the two run against each other

  Side side() const { return lateral_m > 0.0 ? Side::left : Side::right; }
};

/// Lane boundaries that run side by side (paper, Sec. III-D-2).
struct RoadSection {
  std::vector<std::size_t> boundaries;  ///< indices, ascending
};

/// The boundaries of a map, grouped into road sections.
struct SectionGraph {
  Boundaries boundaries;
  std::vector<RoadSection> sections;
  /// Per boundary: the boundaries that it overlaps with, the nearest first. It serves as the paper's
  /// left-to-right order does, but also where boundaries of one section begin and end at different places.
  std::vector<std::vector<SideBySide>> beside;
};

/// Groups the boundaries into road sections: connected components of the graph that joins boundaries of
/// similar direction that overlap. The boundaries of a section are turned to run in one direction. It is the
/// vehicle's heading if the section passes the vehicle, or else the direction of the longest boundary. Round
/// the corners of an intersection there may be no common direction: then the boundaries nearest to the
/// vehicle decide, and some that are further off stay opposed.
SectionGraph road_sections(Boundaries boundaries, const Eigen::Isometry3d& T_map_body,
                           const SectionConfig& config);

}  // namespace laneloom::boundaries
