#pragma once

#include <deque>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "laneloom/reasons.hpp"
#include "laneloom/stages.hpp"
#include "laneloom/types.hpp"
#include "why/reason_text.hpp"

namespace laneloom::why {

/// Asks a mapper for its reasons, and keeps those of the last 10 s. The method `voxels` gives none. Not
/// thread-safe.
class ReasonHistory final : public StageObserver {
 public:
  void update_begins() override;
  void stage_done(Stage stage) override;
  FrameReasons* reasons() override { return &now_; }

  /// Why a line is in the map, or is not, or ended, in sentences. Empty: it was not followed within 10 s.
  std::vector<std::string> of_line(ElementId id) const;
  /// The same of a lane, and then of the lines on its left and right.
  std::vector<std::string> of_lane(ElementId id) const;
  /// The same of a lane of the map after the last update, with where along the lane each line lies.
  std::vector<std::string> of_lane(const Lane& lane) const;
  /// What became of a detection of the last frame. Empty: the frame has no detection of this number.
  std::string of_detection(std::size_t number) const;
  /// The same of a lane, stop line or line of this id, whichever the map has.
  std::vector<std::string> of(ElementId id, const LocalMap& map) const;

  /// All reasons of the last frame: {"lines": {id: {"text": […], "log_odds": 1.2}}, "lanes": {id: {"text":
  /// […], "log_odds": 1.2, "lines": [id]}}, "detections": [{"text": "…", "lines": [id]}], "publish": 1,
  /// "confirm": 2, "show_lane": 1, "hide_lane": 0}. Empty: there are none.
  nlohmann::json to_json(const LocalMap& map) const;

 private:
  Sightings sightings_of(ElementId id) const;
  std::vector<std::string> terms_of_lane(ElementId id) const;
  std::vector<std::string> lines_of_lane(ElementId id, const std::set<ElementId>& told) const;
  /// The first frame of the last 3 s. There must be a frame.
  std::deque<FrameReasons>::const_iterator first_lately() const;

  FrameReasons now_;
  std::deque<FrameReasons> frames_;  ///< the newest last
};

}  // namespace laneloom::why
