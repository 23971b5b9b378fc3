#pragma once

#include "mapping/boundaries/lane_boundaries.hpp"
#include "mapping/markings/id_source.hpp"

namespace laneloom {

/// Cuts boundaries that pass over or under themselves, half the way between, so that beside each place there
/// is one stretch of a boundary. No local map has such a one.
Boundaries cut_self_crossings(Boundaries all, IdSource& ids);

}  // namespace laneloom
