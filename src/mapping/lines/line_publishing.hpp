#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "mapping/lines/line_map.hpp"
#include "mapping/markings/pair_history.hpp"

namespace laneloom {

/// The lines that exist by all that is known of them as markings, as far as their stations tell that they
/// reach: also beyond the local range. Of `doubles`, lines that lie side by side, the weaker one of a type is
/// held back until the two are seen together.
std::vector<Marking> publish_lines(const std::vector<Line>& lines, const PairHistories& doubles,
                                   const MapperConfig& config);

}  // namespace laneloom
