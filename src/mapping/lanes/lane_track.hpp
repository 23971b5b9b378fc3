#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "laneloom/types.hpp"

/// Lanes as they are kept from frame to frame. Ours.
namespace laneloom::lanes {

/// A place of a lane: a cross-section between its borders.
struct LaneStation {
  std::array<Point, 2> border{Point::Zero(), Point::Zero()};  ///< by side, map frame
  /// By side, the boundary that the border lies on, as it was last found.
  std::array<ElementId, 2> boundary{kNoElement, kNoElement};
  double log_odds = 0.0;                            ///< that the lane is there
  double probability = -1.0;                        ///< of its borders, as last found; -1: not estimated
  ElementStatus status = ElementStatus::tentative;  ///< likewise
  Evidence evidence = Evidence::none;               ///< likewise
  double parted = 0.0;   ///< evidence that one lane ends here and another one begins at the next place
  bool stepped = false;  ///< the borders may step aside between here and the next place
  bool shown = false;    ///< the last map showed the lane here
  bool found = false;    ///< the last frame found the lane here: the borders lie on their boundaries

  Point center() const { return 0.5 * (border[0] + border[1]); }
  double width_m() const { return (border[1] - border[0]).head<2>().norm(); }
  void swap_sides();

  template <class Archive>
  void serialize(Archive& archive) {
    archive(border, boundary, log_odds, probability, status, evidence, parted, stepped, shown, found);
  }
};

/// A lane that is followed from frame to frame.
struct LaneTrack {
  ElementId id = kNoElement;
  std::vector<LaneStation> stations;  ///< some LaneConfig::step_m apart
  std::array<double, 2> parted{};     ///< by end: evidence that another lane begins there
  std::uint32_t section = 0;          ///< of the lane that was found there last
  Point begin = Point::Zero();        ///< of the centerline that the map was given last
  int published = 0;  ///< 1: the last map's lane ran along the stations; -1: against them; 0: a new lane
  // What is known of the direction of traffic; log odds are positive along the stations.
  double direction_log_odds = 0.0;            ///< of what was observed
  double belief = 0.0;                        ///< log odds of its direction, smoothed over frames
  Evidence belief_evidence = Evidence::none;  ///< what they rest on
  int told_direction = 0;  ///< 1, -1: the last map told that traffic runs so; 0: it told no direction
  bool driven = false;     ///< by the vehicle

  template <class Archive>
  void serialize(Archive& archive) {
    archive(id, stations, parted, section, begin, published, direction_log_odds, belief, belief_evidence,
            told_direction, driven);
  }
};

/// The centers of stations, in their order.
Polyline centerline(const std::vector<LaneStation>& stations);
/// Lets stations, or a whole track, run the other way.
void reverse(std::vector<LaneStation>& stations);
void reverse(LaneTrack& track);

}  // namespace laneloom::lanes
