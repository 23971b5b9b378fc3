#pragma once

#include <optional>

#include "laneloom/polyline.hpp"
#include "laneloom/types.hpp"

namespace laneloom::boundaries {

/// The side of a line on which it bounds a round island, as that of a roundabout: it turns to that side
/// everywhere, on a radius of 4 to 25 m, and by 100 degrees or more in all. Empty: it bounds none. The kerb
/// of a bend, of a hairpin or of a median has straight parts.
std::optional<Side> island_side(const MeasuredPolyline& line);

}  // namespace laneloom::boundaries
