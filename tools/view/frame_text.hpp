#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "laneloom/config.hpp"
#include "view/events.hpp"
#include "view/moment.hpp"

/// What the page is sent of a moment, as JSON.
namespace laneloom {

/// Where a frame stands among the others of its view.
struct FramePlace {
  std::uint64_t number = 0;  ///< counts up by one: a viewer sees which ones it lost
  std::vector<ViewEvent> events;
};

/// One object with what the strips and the list of events need: stamps, state, times, lineage.
std::string summary_text(const ViewMoment& moment, const FramePlace& place);

/// The summary with the elements to draw, of the maps to compare with likewise, and the status. `range` is
/// the map's range box, for where the status does not tell it.
std::string frame_text(const ViewMoment& moment, const FramePlace& place, const RangeConfig& range);

}  // namespace laneloom
