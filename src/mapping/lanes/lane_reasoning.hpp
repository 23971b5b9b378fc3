#pragma once

#include <map>
#include <optional>
#include <vector>

#include "laneloom/reasons.hpp"
#include "mapping/geometry/map_box.hpp"
#include "mapping/lanes/lane_strips.hpp"
#include "mapping/lanes/lane_track.hpp"

namespace laneloom::lanes {

/// Notes why the lanes of one frame are there, step by step in the order of its functions. Without a place to
/// note it to, every function returns at once. Not thread-safe.
class LaneReasoning {
 public:
  /// `to` may be null. `tracks` are those before the frame.
  LaneReasoning(FrameReasons* to, const std::vector<LaneTrack>& tracks);

  /// A track with the evidence of this frame, before it grows or is cut.
  void observed(const LaneTrack& track, const std::vector<Match>& matches);
  /// A track after the frame, with the lane that is shown of it.
  void decided(const LaneTrack& track, const std::optional<Lane>& lane);
  /// Notes all, with the lanes that ended. `tracks` are those after the frame.
  void ended(const std::vector<LaneTrack>& tracks, const geometry::MapBox& box);

 private:
  /// A lane before the frame.
  struct Before {
    std::vector<Point> places;
    LaneReason reason;  ///< of which only what outlives the lane
  };

  FrameReasons* to_;
  std::map<ElementId, Before> before_;
  std::map<ElementId, LaneReason> lanes_;
};

}  // namespace laneloom::lanes
