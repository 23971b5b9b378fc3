#pragma once

#include "export/accumulate.hpp"
#include "laneloom/config.hpp"
#include "laneloom/types.hpp"

namespace laneloom {

/// The lanes of a whole drive and their linkages, by the same rules by which the mapper finds those of a
/// local map: there is one map, whatever the local maps said at their rims. Directions and linkages that the
/// vehicle drove count as driven. The result keeps the contract of a local map; its stamp and pose stay
/// unset. `config` is valid; its range is not used.
LocalMap weave(const DriveAccumulator::Drive& drive, const MapperConfig& config);

}  // namespace laneloom
