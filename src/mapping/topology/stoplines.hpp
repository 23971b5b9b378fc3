#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"

namespace laneloom::topology {

/// Whether a stopline lies across an end of a lane, or close before or behind it.
bool crosses_end(const Marking& stopline, const Lane& lane, End end, const StoplineConfig& config);

/// The stoplines among `markings`, each with the lanes whose traffic waits there: those that it crosses, or
/// whose end lies close before it. Of a lane of known direction, it is not at the begin. Its heading is that
/// of the lanes; in the middle of a lane of unknown direction it has none.
std::vector<Stopline> tie_stoplines(const std::vector<Marking>& markings, const std::vector<Lane>& lanes,
                                    const StoplineConfig& config);

}  // namespace laneloom::topology
