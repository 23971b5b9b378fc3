#pragma once

#include <span>
#include <vector>

#include "laneloom/types.hpp"
#include "mapping/lines/line_map.hpp"

namespace laneloom::lines {

/// From the middle of a narrow car to its side: a true edge may be near a broad one.
inline constexpr double kHalfBody_m = 0.8;

/// Takes all evidence from the places of road edges that a vehicle's body passed over along the edge, since
/// no edge is there. `way` are places that the vehicle drove through, map frame. A vehicle crosses an edge
/// where a kerb is lowered: more than 25 degrees across its way, an edge stays.
void deny_driven_over(std::span<const Point> way, std::vector<Line>& lines);

}  // namespace laneloom::lines
