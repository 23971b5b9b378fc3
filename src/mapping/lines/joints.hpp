#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "mapping/lines/association.hpp"
#include "mapping/lines/line_map.hpp"
#include "mapping/markings/pair_history.hpp"

namespace laneloom {

/// Counts for the ends of lines that lie within `max_gap_m` of each other how the frame's detections saw
/// them: as places of one marking that runs through both (together), or of two that meet (apart).
void count_joints(const std::vector<LineMatch>& matches, const std::vector<Line>& lines, double max_gap_m,
                  PairHistories& joints);

}  // namespace laneloom
