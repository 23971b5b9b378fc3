#pragma once

#include <cstddef>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/polyline.hpp"
#include "mapping/lane_boundaries.hpp"

namespace laneloom {

/// Where one boundary lies beside another, over the stretch that they have in common.
struct SideBySide {
  std::size_t right = 0;    ///< index of the boundary on the right
  double distance_m = 0.0;  ///< mean
  double length_m = 0.0;    ///< of that stretch
};

/// Lane boundaries that run side by side (paper, Sec. III-D-2).
struct RoadSection {
  std::vector<std::size_t> boundaries;  ///< indices, ascending
};

struct SectionGraph {
  std::vector<RoadSection> sections;
  /// Per boundary: those on its right that it overlaps with, the nearest first. What the paper's
  /// left-to-right order gives, but also where boundaries of one section begin and end at different places.
  std::vector<std::vector<SideBySide>> right_of;
};

/// Groups the boundaries into road sections: connected components of the graph that joins boundaries of
/// similar direction that overlap. All boundaries of a section are turned to run in one
/// direction: the vehicle's heading where the section passes it, or else the longest boundary's own.
/// `measured` is kept parallel.
SectionGraph road_sections(const SectionConfig& config, const Eigen::Isometry3d& T_map_body,
                           std::vector<LaneBoundary>& boundaries, std::vector<MeasuredPolyline>& measured);

}  // namespace laneloom
