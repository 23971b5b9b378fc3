#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "mapping/lanes/lane_strips.hpp"
#include "mapping/lanes/lane_track.hpp"
#include "mapping/markings/id_source.hpp"

namespace laneloom::lanes {

/// Lets tracks grow along the strips of a frame. A strip that runs on beyond the end of a track extends it. A
/// strip from the end of one track to the end of another one joins them, and the older one that was shown
/// keeps its id; two whose shown parts are far apart wait until what lies between them is shown. What no
/// track covers is a new track. Where a strip shows two tracks in one place, the weaker one is forgotten.
/// `matches` are those of each track.
void grow(const std::vector<Strip>& strips, const std::vector<std::vector<Match>>& matches,
          const LaneConfig& config, markings::IdSource& ids, std::vector<LaneTrack>& tracks);

}  // namespace laneloom::lanes
