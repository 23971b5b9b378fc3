#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "laneloom/basics.hpp"

/// Why the method `lines` did what it did in one frame. An observer that gives StageObserver::reasons() a
/// place is told.
namespace laneloom {

/// What became of a detection.
struct DetectionFate {
  /// The rule that decided.
  enum class Rule : std::uint8_t {
    repeats,   ///< not looked at: the vehicle stands, and saw the same a moment ago
    zigzag,    ///< dropped: it zigzags, or has fewer than two points
    unsure,    ///< dropped: its confidence is too low
    observes,  ///< it observes lines that were there before
    begins,    ///< a new line begins with it
    unused     ///< it fits no line, and is too short for a new one, or out of range
  };
  Rule rule = Rule::unused;
  bool in_row = false;           ///< it was joined with other dashes to one line
  std::vector<ElementId> lines;  ///< lines that it observes, or that begin with it
};

/// What was decided about a line, and the terms of its evidence.
struct LineReason {
  enum class Verdict : std::uint8_t {
    confirmed,
    tentative,
    held_back,  ///< a stronger line `other` lies beside it, and the two were not seen together yet
    weak,       ///< its evidence does not suffice to publish it
    too_short,  ///< what is sure of it is too short to publish it
    merged,     ///< it ended: it is part of `other` now
    lost,       ///< it ended: its evidence was lost, as it was in view and not detected
    passed      ///< it ended: it left the range of the map
  };
  ElementId id = kNoElement;
  MarkingType type = MarkingType::laneline;
  Verdict verdict = Verdict::weak;
  ElementId other = kNoElement;
  // Log odds that the line exists. Their sum decides.
  double by_stations = 0.0;  ///< by how often its places were seen and missed: the mean over its places
  double by_belief = 0.0;    ///< by the confidence of its detections
  double gained = 0.0;       ///< part of `by_stations` that this frame added, at places known before
  std::size_t places = 0, observed = 0, missed = 0;  ///< number of places, about one a metre
  std::vector<std::size_t> detections;               ///< indices of those that observed it in this frame
};

/// The decision about a lane, and the terms of its evidence.
struct LaneReason {
  enum class Verdict : std::uint8_t {
    shown,      ///< it is in the map
    weak,       ///< its evidence does not suffice to show it
    too_short,  ///< what would be shown of it is too short
    replaced,   ///< it ended: the lane `other` lies in its place now
    lost,       ///< it ended: its evidence was lost
    passed      ///< it ended: it left the range of the map
  };
  ElementId id = kNoElement;
  Verdict verdict = Verdict::weak;
  ElementId other = kNoElement;
  double log_odds = 0.0;  ///< that it is there: the mean over its places; each decides for itself
  double gained = 0.0;    ///< part of it that this frame added, at places known before
  std::vector<ElementId> left, right;  ///< boundaries that its borders lie on
  // Number of places, about one a metre. First of those known before: what the frame said.
  std::size_t observed = 0;  ///< known before
  std::size_t found = 0;     ///< the frame shows the lane there
  std::size_t denied = 0;    ///< the frame shows its borders, and no lane between them
  std::size_t taken = 0;     ///< the frame shows another lane there, or a shoulder
  // Then of those after the frame.
  std::size_t places = 0;  ///< all
  std::size_t shown = 0;   ///< in the map
  std::size_t confirmed = 0,
              inferred = 0;  ///< shown ones between confirmed borders, or beside an inferred one
  // Log odds that traffic runs along its points, if it is in the map; in common with the lanes that continue
  // it.
  double by_drive = 0.0;    ///< by the own drive, and by stop lines
  double by_borders = 0.0;  ///< by the borders of the road and the driving side
  double by_trails = 0.0;   ///< by trails of other vehicles
  double by_streets = 0.0;  ///< by one-way streets of the SD map
  double by_beside = 0.0;   ///< by the lanes beside it
  double direction = 0.0;   ///< the sum, smoothed over frames
};

struct FrameReasons {
  std::int64_t stamp_ns = 0;
  bool repeats = false;                   ///< the vehicle stands: what was decided in the frame before holds
  double publish = 0.0, confirm = 0.0;    ///< log odds that are needed
  std::vector<DetectionFate> detections;  ///< of each detection of the frame
  std::vector<LineReason> lines;  ///< of all lines that are followed, and of those that ended in this frame
  double show_lane = 0.0;         ///< log odds from which on a place of a lane is shown
  double hide_lane = 0.0;         ///< log odds below which it is shown no longer
  std::vector<LaneReason> lanes;  ///< of all lanes that are followed, and of those that ended in this frame
};

}  // namespace laneloom
