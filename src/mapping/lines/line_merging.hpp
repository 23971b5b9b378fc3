#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "mapping/lines/line_map.hpp"
#include "mapping/markings/pair_history.hpp"
#include "mapping/markings/relatives.hpp"

namespace laneloom {

/// What a line weighs against another one in its place: its length times the evidence for it.
double weight(const Line& line, const FusionConfig& config);

/// Counts which neighbouring lines are seen in the same frame, as two real lines are, and which in different
/// ones, as a line and its double are. Of two that are, the one with less evidence goes. Returns what went,
/// each with the line that stays.
std::vector<Relative> merge_doubles(const FusionConfig& config, std::vector<Line>& lines,
                                    PairHistories& doubles);

}  // namespace laneloom
