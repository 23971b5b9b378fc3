#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "mapping/lines/association.hpp"
#include "mapping/lines/line_map.hpp"
#include "mapping/markings/pair_history.hpp"

namespace laneloom {

/// Counts for the lines that end within `max_gap_m` of each other how the frame's detections saw them: as the
/// one marking that they are pieces of (together), or as two that meet (apart).
void count_joints(const std::vector<LineMatch>& matches, const std::vector<Line>& lines, double max_gap_m,
                  PairHistories& joints);

}  // namespace laneloom
