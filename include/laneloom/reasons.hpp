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

struct FrameReasons {
  std::int64_t stamp_ns = 0;
  double publish = 0.0, confirm = 0.0;    ///< log odds that are needed
  std::vector<DetectionFate> detections;  ///< of each detection of the frame
  std::vector<LineReason> lines;  ///< of all lines that are followed, and of those that ended in this frame
};

}  // namespace laneloom
