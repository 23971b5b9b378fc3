#pragma once

#include <utility>
#include <vector>

#include "laneloom/types.hpp"
#include "mapping/boundaries/lane_boundaries.hpp"
#include "mapping/markings/relatives.hpp"

namespace laneloom {

/// Which published element each marking was part of: pairs of (marking, element), by ascending marking.
using Membership = std::vector<std::pair<ElementId, ElementId>>;

/// Boundaries with their members, and stoplines, each of which is its own.
Membership membership(const Boundaries& boundaries, const std::vector<Stopline>& stoplines);

/// What happened to the published ids from one map to the next, by ascending id. `relatives` are of the lines
/// that came or went in between.
std::vector<LineageEvent> lineage(const Membership& before, const Membership& now,
                                  const std::vector<Relative>& relatives);

}  // namespace laneloom
