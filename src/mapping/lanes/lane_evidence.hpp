#pragma once

#include <cstddef>
#include <vector>

#include "laneloom/config.hpp"
#include "mapping/lanes/lane_strips.hpp"
#include "mapping/lanes/lane_track.hpp"

/// The evidence that a lane is there, as log odds.
namespace laneloom::lanes {

/// From here on, a lane is shown.
inline constexpr double kShown = 1.0;
/// Below, a lane that was shown is shown no longer.
inline constexpr double kHidden = 0.0;
/// Below, a lane is forgotten.
inline constexpr double kForgotten = -1.0;
/// From here on, one lane ends at a place and another one begins.
inline constexpr double kParted = 1.5;
/// The most evidence of a parting.
inline constexpr double kMostParted = 3.0;
/// Evidence of a frame against a parting: one lane runs through.
inline constexpr double kPassing = 0.3;
/// On both sides of a parting, the lanes are at least that long.
inline constexpr double kAside_m = 5.0;

/// Whether the evidence shows a station, or lets it be shown on.
bool is_to_show(const LaneStation& station);

/// Whether so many hidden stations between shown ones are shown. More of them part a lane.
bool is_bridged(std::size_t hidden, const LaneConfig& config);

/// What the first frame that finds a lane says.
double first_evidence(ElementStatus status);

/// Moves the stations of a track to where a frame found them, and weighs the evidence of the frame. A station
/// that was not found moves with those beside it. `matches` are the track's.
void observe(const std::vector<Strip>& strips, const std::vector<Match>& matches, const LaneConfig& config,
             LaneTrack& track);

}  // namespace laneloom::lanes
