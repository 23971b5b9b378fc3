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

/// Makes one line of two of which one continues the other. Either detections have run from the end of one to
/// the end of the other (`joints`), and these meet. Or the two lie side by side where they end, and are not
/// seen together there; `overlaps` counts this, and is continued by one frame. The older line keeps its id.
/// Where the two overlap, the stations of more evidence stay. Returns what was joined. Ours.
std::vector<Joined> join_lines(const FusionConfig& config, const markings::PairHistories& joints,
                               std::vector<Line>& lines, markings::PairHistories& overlaps);

}  // namespace laneloom::lines
