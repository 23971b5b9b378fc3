#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"

namespace laneloom {

/// The stoplines among `markings`, each with the lanes that it ends: those with an end close to it, crossed
/// by it.
std::vector<Stopline> tie_stoplines(const std::vector<Marking>& markings, const std::vector<Lane>& lanes,
                                    const StoplineConfig& config);

}  // namespace laneloom
