#pragma once

#include "mapping/boundaries/lane_boundaries.hpp"
#include "mapping/markings/id_source.hpp"

namespace laneloom::exports {

/// Cuts boundaries that pass over or under themselves, in the middle between the two places, so that a place
/// has one stretch of a boundary beside it. Local maps have no such boundaries.
boundaries::Boundaries cut_self_crossings(boundaries::Boundaries all, markings::IdSource& ids);

}  // namespace laneloom::exports
