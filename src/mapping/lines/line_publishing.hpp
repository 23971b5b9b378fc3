#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "mapping/lines/line_map.hpp"
#include "mapping/markings/pair_history.hpp"

namespace laneloom::lines {

/// Makes markings of the lines whose evidence suffices, from their first to their last station of enough
/// evidence. They may reach beyond the local range. `doubles` are lines that lie side by side: of two of one
/// type, the weaker one is held back until both are seen together.
std::vector<Marking> publish_lines(const std::vector<Line>& lines, const markings::PairHistories& doubles,
                                   const MapperConfig& config);

}  // namespace laneloom::lines
