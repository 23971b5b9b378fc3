#pragma once

#include <cstddef>
#include <vector>

#include "mapping/lines/line_map.hpp"

namespace laneloom::lines {

/// Forgets lines that there is no room for, so that a flood of false detections does not make frames slow.
/// There is room for 256 lines with 20000 stations together, and for four lines in a square metre: a double
/// line, a kerb and a stopline. The lines that are believed most stay, and of equals the first ones. Returns
/// how many are forgotten.
std::size_t keep_within_room(std::vector<Line>& lines);

}  // namespace laneloom::lines
