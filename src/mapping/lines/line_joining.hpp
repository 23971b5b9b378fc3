#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "mapping/lines/line_map.hpp"
#include "mapping/markings/pair_history.hpp"
#include "mapping/markings/relatives.hpp"

namespace laneloom::lines {

/// Makes one line of two of which one continues the other. Either detections have run from the end of one to
/// the end of the other (`joints`), and these meet. Or the two lie side by side where they end, and take
/// turns there, as a line and its double do; `overlaps` counts this, and is continued by one frame. The older
/// line stays. It goes on with the other one's stations from where it ends. Returns the lines that are gone,
/// each with the line that it is part of now. Ours.
std::vector<markings::Relative> join_lines(const FusionConfig& config, const markings::PairHistories& joints,
                                           std::vector<Line>& lines, markings::PairHistories& overlaps);

}  // namespace laneloom::lines
