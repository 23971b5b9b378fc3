#pragma once

#include <cstdint>

#include "mapping/lanes/road_cuts.hpp"

/// What speaks for and against a lane at a place, as a sum of log odds. Ours.
namespace laneloom::lanes {

/// How a lane may lie in a cross-section.
enum class Room : std::uint8_t {
  between,    ///< between two marks
  divided,    ///< two lanes between two marks, with an unseen border in the middle
  open_left,  ///< on the left of a mark, with an unseen left border
  open_right  ///< likewise on the right
};
inline constexpr bool is_open(Room room) { return room == Room::open_left || room == Room::open_right; }

/// A mark this near to a border, in metres, does not lie within the lane.
inline constexpr double kBesideBorder_m = 0.6;

/// A lane that a cross-section may have.
struct Candidate {
  Room room = Room::between;
  std::size_t left = 0, right = 0;  ///< marks of the cross-section; the same one where a side is open
  double taper = 0.0;               ///< change of the width along the road, metres per metre
  double parted = 0.0;       ///< between two marks, from 0 to 1: how near along the road a line parts them
  bool driven = false;       ///< the vehicle drives in it
  bool room_driven = false;  ///< open: the vehicle drives between its mark and the next one
  bool here = false;         ///< near this place
  bool gore = false;         ///< its borders meet at an end of it, and neither may be crossed up to here
};

/// The distance between the marks; of an open lane, the room up to the next mark. Metres.
double width_m(const RoadCut& cut, const Candidate& candidate);

/// Whether a mark is an edge, or has one along it on that side.
bool is_kerb(const RoadCut& cut, std::size_t mark, Side side);

/// The log odds that the lane (if divided: that each of the two) is there. The weights were fitted to
/// simulated and real roads, by logistic regression (src/mapping/README.md).
double log_odds(const RoadCut& cut, const Candidate& candidate, const LaneConfig& config);

/// Whether a candidate may be a shoulder: it lies between a line and an edge.
bool may_be_shoulder(const RoadCut& cut, const Candidate& candidate);

/// The log odds that a candidate that may be a shoulder is one. The weights were set by hand.
double shoulder_log_odds(const RoadCut& cut, const Candidate& candidate, const LaneConfig& config);

/// Whether a candidate may be a cycle lane: it lies beside a line, and is as narrow as one.
bool may_be_cycle_lane(const RoadCut& cut, const Candidate& candidate, const LaneConfig& config);

/// The log odds that a candidate between two marks is a cycle lane. The weights were set by hand.
double cycle_log_odds(const RoadCut& cut, const Candidate& candidate, const LaneConfig& config);

}  // namespace laneloom::lanes
