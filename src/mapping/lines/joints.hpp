#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "mapping/lines/association.hpp"
#include "mapping/lines/line_map.hpp"
#include "mapping/markings/pair_history.hpp"

namespace laneloom::lines {

/// Counts how a frame's detections saw ends of lines that lie within `max_gap_m` of each other. `together`:
/// one detection ran through both ends. `apart`: two detections saw one end each.
void count_joints(const std::vector<LineMatch>& matches, const std::vector<Line>& lines, double max_gap_m,
                  markings::PairHistories& joints);

}  // namespace laneloom::lines
