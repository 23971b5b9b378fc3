#pragma once

#include <vector>

#include "laneloom/types.hpp"

namespace laneloom::simulation {

/// The parts of the areas' outlines where no other area (at about the same height) adjoins or overlaps. An
/// outline that no area adjoins is a ring, whose last point is its first. `areas` need not repeat their first
/// point.
std::vector<Polyline> outer_edges(const std::vector<Polyline>& areas);

}  // namespace laneloom::simulation
