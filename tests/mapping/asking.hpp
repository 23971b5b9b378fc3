#pragma once

#include "laneloom/reasons.hpp"
#include "laneloom/stages.hpp"
#include "straight_road.hpp"

namespace laneloom {

/// Asks why the map is as it is, and keeps the answer of the newest update.
class Asking : public StageObserver {
 public:
  void update_begins() override {}
  void stage_done(Stage) override {}
  FrameReasons* reasons() override { return &now; }

  FrameReasons now;
};

/// A frame on a straight road, whose network sees 40 m ahead and 10 m to each side.
inline DetectionFrame seen_on_straight_road(std::int64_t time_ms, std::int64_t period_ms) {
  DetectionFrame frame = frame_on_straight_road(time_ms, period_ms);
  frame.field_of_view = {{-5, -10, 0}, {40, -10, 0}, {40, 10, 0}, {-5, 10, 0}};
  return frame;
}

}  // namespace laneloom
