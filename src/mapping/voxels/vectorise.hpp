#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "mapping/geometry/map_box.hpp"
#include "mapping/markings/id_source.hpp"
#include "mapping/voxels/instances.hpp"
#include "mapping/voxels/voxel_map.hpp"

namespace laneloom::voxels {

/// Estimates the polyline and the styles of every instance whose voxels changed. A line keeps the direction
/// that it had; a new one runs along `forward`.
void update_polylines(const PolylineConfig& config, const StyleConfig& style_config, const VoxelMap& map,
                      const Eigen::Vector2d& forward, Instances& instances);

/// The instances' polylines within the local range, as markings. The further stretches of a line that leaves
/// the range and comes back have ids of their own.
std::vector<Marking> markings_in_range(const geometry::MapBox& range, double min_length_m,
                                       Instances& instances, markings::IdSource& ids);

/// The styles along `line`, from the votes of the voxels nearest to each stretch (paper, Sec. IV-E). Covers
/// the line.
std::vector<StyleRange> estimate_styles(const Polyline& line, const std::vector<VoxelId>& voxels,
                                        const VoxelMap& map, const StyleConfig& config);

}  // namespace laneloom::voxels
