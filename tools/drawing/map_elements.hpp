#pragma once

#include "drawing/drawing.hpp"
#include "laneloom/types.hpp"

/// What of a map can be drawn. What has no extent is left out. Pure functions but for the drawing.
namespace laneloom {

/// Lanes, boundaries, stoplines and linkages; takes over the map's stamp, pose and lineage.
void add_map(const LocalMap& map, Drawing& drawing);

/// The fused markings, before they are grouped into boundaries.
void add_markings(const LocalMap& map, Drawing& drawing);
/// Bands of two standard deviations to each side of boundaries whose deviation is known.
void add_uncertainty(const LocalMap& map, Drawing& drawing);
/// The ids of lanes, boundaries and stoplines, as texts.
void add_ids(const LocalMap& map, Drawing& drawing);

/// The parts of add_map().
void add_lanes(const LocalMap& map, Drawing& drawing);
void add_linkages(const LocalMap& map, Drawing& drawing);
void add_boundaries(const LocalMap& map, Drawing& drawing);
void add_stoplines(const LocalMap& map, Drawing& drawing);

/// The way that a linkage takes: out of the end of one lane's centerline and into the begin of the other's,
/// also where traffic runs against them, as linkages are in the order of the points.
Polyline linkage_path(const Linkage& linkage, const Lane& from, const Lane& to);

}  // namespace laneloom
