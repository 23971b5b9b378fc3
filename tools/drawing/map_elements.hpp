#pragma once

#include "drawing/drawing.hpp"
#include "laneloom/types.hpp"

/// Adds parts of a map to a drawing. Lines without extent are left out. The functions change nothing but the
/// drawing.
namespace laneloom::drawing {

/// Adds lanes, boundaries, stoplines, linkages, the own way and where others drove. Takes over the map's
/// stamp, pose and lineage.
void add_map(const LocalMap& map, Drawing& drawing);

/// Adds the fused markings, before they are joined to boundaries.
void add_markings(const LocalMap& map, Drawing& drawing);
/// Adds bands of two standard deviations to each side of boundaries whose deviation is known.
void add_uncertainty(const LocalMap& map, Drawing& drawing);
/// Adds the ids of lanes, boundaries and stoplines, as texts.
void add_ids(const LocalMap& map, Drawing& drawing);

/// The parts of add_map().
void add_lanes(const LocalMap& map, Drawing& drawing);
void add_linkages(const LocalMap& map, Drawing& drawing);
void add_boundaries(const LocalMap& map, Drawing& drawing);
void add_stoplines(const LocalMap& map, Drawing& drawing);
void add_way(const Way& way, Drawing& drawing);
void add_driven_path(const DrivenPath& path, Drawing& drawing);

/// The line to draw for a linkage: out of the end of one lane's centerline and into the beginning of the
/// other's. Linkages follow the order of the points, also if traffic runs against it.
Polyline linkage_path(const Linkage& linkage, const Lane& from, const Lane& to);

}  // namespace laneloom::drawing
