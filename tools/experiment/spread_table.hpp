#pragma once

#include <string>
#include <vector>

#include "experiment/experiment.hpp"

namespace laneloom {

/// A Markdown table of how far the single drives are apart: mean, worst decile and worst of the F1 of
/// markings and lanes, and of the way in F1 from single detections (0) to the oracle (1). A row for the
/// single detections, every configuration and the peer. `results` are of `drives`, with the oracle. Drives
/// whose oracle is less than ten points above the single detections have hardly a way to go, and do not count
/// there.
std::string spread_table(const std::vector<DriveSpec>& drives, const std::vector<DriveResults>& results);

}  // namespace laneloom
