#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"

namespace laneloom::topology {

/// Whether a stopline lies across an end of a lane, or close before or behind it.
bool crosses_end(const Marking& stopline, const Lane& lane, End end, const StoplineConfig& config);

/// The stoplines among `markings`, each with the lanes that it ends. It ends a lane that it crosses at its
/// end, or, if the driving direction of the lane is not known, at either end. Its heading is that of the
/// lanes.
std::vector<Stopline> tie_stoplines(const std::vector<Marking>& markings, const std::vector<Lane>& lanes,
                                    const StoplineConfig& config);

}  // namespace laneloom::topology
