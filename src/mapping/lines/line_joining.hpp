#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "mapping/lines/line_map.hpp"
#include "mapping/markings/pair_history.hpp"

namespace laneloom::lines {

/// Two lines that became one: the end of the older line that stays, and the end of the line that is gone.
struct Joined {
  ElementId stays = kNoElement;
  End end = End::back;
  ElementId gone = kNoElement;
  End gone_end = End::front;
};

/// Makes one line of two of which one continues the other. Two ends are joined if they meet and detections
/// have run through both (`joints`). Two ends are joined as well if they lie side by side and are not seen
/// together there. `overlaps` counts that, and is continued by one frame. The joined line has the id of the
/// older one. Of an overlap, it has the stations of the line with more evidence there. `grid`
/// holds the stations of the lines. Returns what was joined. Ours.
std::vector<Joined> join_lines(const FusionConfig& config, const markings::PairHistories& joints,
                               StationGrid grid, std::vector<Line>& lines, markings::PairHistories& overlaps);

}  // namespace laneloom::lines
