#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "mapping/lines/line_map.hpp"
#include "mapping/markings/pair_history.hpp"
#include "mapping/markings/relatives.hpp"

namespace laneloom::lines {

/// The weight of a line against another one in its place: its length times its evidence.
double weight(const Line& line, const FusionConfig& config);

/// Counts for neighbouring lines in how many frames both were seen, and in how many only one of them. Two
/// real lines are seen together; a line and its double take turns. Two road edges that lie within 0.3 m of
/// each other, and two lanelines within 0.15 m all along the shorter one, are doubles however often they are
/// seen together. Of a line and its double, the one of less weight is removed. Returns the removed lines,
/// each with the line that stays. `grid` holds the stations of the lines.
std::vector<markings::Relative> merge_doubles(const FusionConfig& config, const StationGrid& grid,
                                              std::vector<Line>& lines, markings::PairHistories& doubles);

}  // namespace laneloom::lines
