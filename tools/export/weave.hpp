#pragma once

#include "export/survey.hpp"
#include "laneloom/config.hpp"
#include "laneloom/types.hpp"

namespace laneloom::exports {

/// Finds the lanes of a surveyed road and their linkages, by the rules of the mapper for a local map. The
/// rims of the local maps do not matter. Directions and linkages that a vehicle drove count as driven, unless
/// `config` takes the vehicle's own drive for no evidence. The result keeps the contract of a local map; its
/// stamp and pose stay unset. `config` must be valid; its range is not used.
LocalMap weave(const SurveyedRoad& surveyed, const MapperConfig& config);

}  // namespace laneloom::exports
