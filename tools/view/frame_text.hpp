#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "laneloom/config.hpp"
#include "view/events.hpp"
#include "view/moment.hpp"
#include "view/quality.hpp"

/// The messages to the page about a moment, as JSON.
namespace laneloom::view {

/// The place of a frame among the frames of its view, and what was found about it.
struct FramePlace {
  std::uint64_t number = 0;           ///< counts up by one, so that a viewer sees which frames it lost
  std::vector<MapQuality> quality{};  ///< of the map, and of each map to compare with; empty: it is repeated
  std::vector<ViewEvent> events{};
};

/// A summary as one object with the data for the strips and the list of events: stamps, state, times,
/// quality, lineage.
std::string summary_text(const ViewMoment& moment, const FramePlace& place);

/// A frame: the summary, the elements to draw of the map and of the maps to compare with, and the status.
/// `range` is the map's range box, in case that the status does not tell it.
std::string frame_text(const ViewMoment& moment, const FramePlace& place, const RangeConfig& range);

}  // namespace laneloom::view
