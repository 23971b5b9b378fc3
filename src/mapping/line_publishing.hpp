#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "mapping/line_map.hpp"
#include "mapping/local_range.hpp"

namespace laneloom {

/// The lines with enough evidence, within the local range, as markings.
std::vector<Marking> publish_lines(const std::vector<Line>& lines, const LocalRange& range,
                                   const MapperConfig& config);

}  // namespace laneloom
