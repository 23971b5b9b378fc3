#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "mapping/lines/line_map.hpp"
#include "mapping/markings/pair_history.hpp"

namespace laneloom::lines {

/// A line beside a stronger one of its type. It is taken for a double of it until the two are seen together.
struct Shadow {
  ElementId line = kNoElement;
  ElementId of = kNoElement;  ///< the stronger one
};
std::vector<Shadow> shadows(const std::vector<Line>& lines, const markings::PairHistories& doubles,
                            const FusionConfig& config);

/// Makes markings of the lines whose evidence suffices, from their first to their last station of enough
/// evidence. They may reach beyond the local range. `doubles` are lines that lie side by side: of two of one
/// type, the weaker one is held back until both are seen together.
std::vector<Marking> publish_lines(const std::vector<Line>& lines, const markings::PairHistories& doubles,
                                   const MapperConfig& config);

}  // namespace laneloom::lines
