#pragma once

#include <optional>

#include "laneloom/types.hpp"
#include "mapping/boundaries/lane_boundaries.hpp"
#include "mapping/lanes/lane_track.hpp"

namespace laneloom::lanes {

/// The lane of a track, along its shown stations. Its borders are the boundaries of the map that lie where
/// the track's borders are; elsewhere they are unseen. Empty: nothing is shown.
std::optional<Lane> shown_lane(const LaneTrack& track, const boundaries::Boundaries& boundaries);

}  // namespace laneloom::lanes
