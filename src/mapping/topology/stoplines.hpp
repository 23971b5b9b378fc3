#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"

namespace laneloom {

/// Whether a stopline lies across that end of the lane, or close beyond.
bool crosses_end(const Marking& stopline, const Lane& lane, End end, const StoplineConfig& config);

/// The stoplines among `markings`, each with the lanes that it ends: those that it crosses at their end, or
/// where the driving direction is not known at either end. Its heading is that of the lanes.
std::vector<Stopline> tie_stoplines(const std::vector<Marking>& markings, const std::vector<Lane>& lanes,
                                    const StoplineConfig& config);

}  // namespace laneloom
