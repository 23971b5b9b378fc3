#pragma once

#include <string>
#include <vector>

#include "experiment/experiment.hpp"

namespace laneloom::experiment {

/// A Markdown table of the spread over single drives: mean, worst decile and worst of the F1 of markings and
/// lanes, and of the way in F1 from single detections (0) to the oracle (1). It has a row for the single
/// detections, each configuration and the peer. `results` are of `drives`, with the oracle. If the oracle is
/// less than ten points above the single detections, the drive does not count for the way, because there is
/// hardly one.
std::string spread_table(const std::vector<DriveSpec>& drives, const std::vector<DriveResults>& results);

}  // namespace laneloom::experiment
