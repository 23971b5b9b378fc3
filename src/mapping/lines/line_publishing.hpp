#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "mapping/lines/line_map.hpp"

namespace laneloom {

/// The lines with enough evidence as markings, as far as they are kept: also beyond the local range.
std::vector<Marking> publish_lines(const std::vector<Line>& lines, const MapperConfig& config);

}  // namespace laneloom
