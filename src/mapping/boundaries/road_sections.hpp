#pragma once

#include <cstddef>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/polyline.hpp"
#include "mapping/boundaries/lane_boundaries.hpp"

namespace laneloom {

/// How another boundary lies beside one, over the stretch that they have in common.
struct SideBySide {
  std::size_t other = 0;   ///< its index
  double lateral_m = 0.0;  ///< mean; positive: on the left, as the one runs
  double length_m = 0.0;   ///< of that stretch
  bool opposed = false;    ///< the two run against each other

  Side side() const { return lateral_m > 0.0 ? Side::left : Side::right; }
};

/// Lane boundaries that run side by side (paper, Sec. III-D-2).
struct RoadSection {
  std::vector<std::size_t> boundaries;  ///< indices, ascending
};

struct SectionGraph {
  Boundaries boundaries;
  std::vector<RoadSection> sections;
  /// Per boundary: those that it overlaps with, the nearest first. What the paper's left-to-right order
  /// gives, but also where boundaries of one section begin and end at different places.
  std::vector<std::vector<SideBySide>> beside;
};

/// Groups the boundaries into road sections: connected components of the graph that joins boundaries of
/// similar direction that overlap. The boundaries of a section are turned to run in one direction: the
/// vehicle's heading where the section passes it, or else the longest boundary's own. Round the corners of an
/// intersection that may have no answer: then what is nearest to the vehicle decides, and further off
/// boundaries stay opposed.
SectionGraph road_sections(Boundaries boundaries, const Eigen::Isometry3d& T_map_body,
                           const SectionConfig& config);

}  // namespace laneloom
