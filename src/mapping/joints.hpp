#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "mapping/association.hpp"
#include "mapping/line_map.hpp"
#include "mapping/pair_history.hpp"

namespace laneloom {

/// Counts for the lines that end within `max_gap_m` of each other how the frame's detections saw them: as the
/// one marking that they are pieces of (together), or as two that meet (apart).
void count_joints(const std::vector<LineMatch>& matches, const std::vector<Line>& lines, double max_gap_m,
                  PairHistories& joints);

/// Whether two lines were long enough seen to be two markings, though they meet.
bool are_separate(const PairHistories& joints, ElementId a, ElementId b);

}  // namespace laneloom
