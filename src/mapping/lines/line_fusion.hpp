#pragma once

#include <cstddef>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "mapping/lines/association.hpp"
#include "mapping/lines/line_map.hpp"
#include "mapping/lines/station_update.hpp"

namespace laneloom::lines {

/// Moves the observed stations towards the observations, each weighed by its deviation. Counts the votes for
/// types and styles. Teaches the networks.
void fuse_matches(const Association& association, const Viewpoint& from, const FusionConfig& config,
                  Networks& networks, std::vector<Line>& lines);

}  // namespace laneloom::lines
