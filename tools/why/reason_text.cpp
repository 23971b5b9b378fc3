#include "why/reason_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <utility>

#include "laneloom/element_names.hpp"

namespace laneloom::why {
namespace {

using Rule = DetectionFate::Rule;
using Verdict = LineReason::Verdict;

std::string verdict_of(const LineReason& line, const FrameReasons& frame) {
  const double log_odds = line.by_stations + line.by_belief;
  switch (line.verdict) {
    case Verdict::confirmed:
      return fmt::format("confirmed, with log odds of {:.2f}; {:.2f} are needed", log_odds, frame.confirm);
    case Verdict::tentative:
      return fmt::format("tentative, with log odds of {:.2f}; {:.2f} are needed to be confirmed", log_odds,
                         frame.confirm);
    case Verdict::held_back:
      return fmt::format(
          "held back: line {} lies beside it and is stronger, and the two were not seen together yet",
          line.other);
    case Verdict::too_short:
      return "not published: what is sure of it is too short (mapper.fusion.min_length_m)";
    case Verdict::merged:
      return fmt::format("ended: it is part of line {} now", line.other);
    case Verdict::lost:
      return "ended: it was in view and not detected until its evidence was lost";
    case Verdict::passed:
      return "ended: it left the range of the map";
    default:
      return fmt::format("not published, with log odds of {:.2f}; {:.2f} are needed", log_odds,
                         frame.publish);
  }
}

std::string verdict_of(const LaneReason& lane, const FrameReasons& frame) {
  using enum LaneReason::Verdict;
  switch (lane.verdict) {
    case shown: {
      if (lane.inferred == lane.shown) return "inferred: at no place are both its borders seen";
      const std::size_t seen = lane.shown - lane.inferred;
      return fmt::format(
          "{}: at {} of the {} places whose borders are seen, both are confirmed; more than half are "
          "needed",
          2 * lane.confirmed > seen ? "confirmed" : "tentative", lane.confirmed, seen);
    }
    case too_short:
      return "not shown: what is sure of it is shorter than 2 m";
    case replaced:
      return fmt::format("ended: lane {} lies in its place now", lane.other);
    case lost:
      return "ended: it was not found until its evidence was lost";
    case passed:
      return "ended: it left the range of the map";
    default:
      return fmt::format("not shown: no place has log odds of {:.2f}, or of {:.2f} where it was shown before",
                         frame.show_lane, frame.hide_lane);
  }
}

/// By which terms the direction of a lane in the map was found. Terms of no weight are left out.
std::string direction_of(const LaneReason& lane) {
  constexpr double kNone = 0.005;
  std::vector<std::string> terms;
  for (const auto& [log_odds, by] :
       {std::pair(lane.by_drive, "the own drive and stop lines"),
        std::pair(lane.by_borders, "the borders of the road and the driving side"),
        std::pair(lane.by_trails, "trails of others"),
        std::pair(lane.by_streets, "one-way streets of the SD map"),
        std::pair(lane.by_beside, "the lanes beside it")})
    if (std::abs(log_odds) >= kNone) terms.push_back(fmt::format("{:+.2f} by {}", log_odds, by));
  if (terms.empty()) terms.emplace_back("nothing tells it now");
  return fmt::format(
      "That its traffic runs along its points has log odds of {:+.2f}, smoothed over frames: {}.",
      lane.direction, fmt::join(terms, ", "));
}

/// The verdict of the frame on the places of a lane that were known before. A verdict on no place is left
/// out.
std::string frame_of(const LaneReason& lane) {
  std::vector<std::string> said;
  for (const auto& [places, what] :
       {std::pair(lane.found, "the lane"), std::pair(lane.denied, "its borders without a lane"),
        std::pair(lane.taken, "another lane or a shoulder"),
        std::pair(lane.observed - lane.found - lane.denied - lane.taken, "nothing")})
    if (places > 0) said.push_back(fmt::format("{} at {}", what, places));
  return fmt::format("This frame added {:+.2f}: of {} places known before, it showed {}.", lane.gained,
                     lane.observed, fmt::join(said, ", "));
}

std::string lines_of(const DetectionFate& detection) {
  return fmt::format("line{} {}", detection.lines.size() == 1 ? "" : "s", fmt::join(detection.lines, ", "));
}

std::string fate_of(const DetectionFate& detection) {
  switch (detection.rule) {
    case Rule::repeats:
      return "not looked at: the vehicle stands, and saw the same a moment ago";
    case Rule::zigzag:
      return "dropped: it zigzags, or has fewer than two points (mapper.preprocess.zigzag_angle_deg)";
    case Rule::unsure:
      return "dropped: its confidence is too low (mapper.preprocess.min_confidence)";
    case Rule::observes:
      return "taken: it observes " + lines_of(detection);
    case Rule::begins:
      return "taken: with it begins " + lines_of(detection);
    default:
      return "not used: it fits no line, and is too short for a new one (mapper.fusion.min_birth_length_m) "
             "or out "
             "of range";
  }
}

}  // namespace

std::vector<std::string> text_of(const LineReason& line, const FrameReasons& frame, const Sightings& lately) {
  std::vector<std::string> text{
      fmt::format("{} {} is {}.", name(line.type), line.id, verdict_of(line, frame)),
      fmt::format("Its log odds: {:.2f} by how often its places were seen, {:+.2f} by the confidence of its "
                  "detections.",
                  line.by_stations, line.by_belief)};
  if (line.places > 0)
    text.push_back(
        fmt::format("This frame added {:+.2f}: of {} places, {} were observed, and {} were in view and "
                    "missed.",
                    line.gained, line.places, line.observed, line.missed));
  std::string now = "No detection of this frame observes it";
  if (line.detections.size() == 1) now = fmt::format("Detection {} observes it", line.detections.front());
  if (line.detections.size() > 1)
    now = fmt::format("Detections {} observe it", fmt::join(line.detections, ", "));
  text.push_back(fmt::format("{}; in the last {:.1f} s, {} of {} frames did.", now, lately.span_s,
                             lately.frames, lately.of));
  return text;
}

std::vector<std::string> text_of(const LaneReason& lane, const FrameReasons& frame) {
  std::vector<std::string> text{fmt::format("Lane {} is {}.", lane.id, verdict_of(lane, frame)),
                                fmt::format("Its log odds are {:.2f}, the mean over its places; a place is "
                                            "shown from {:.2f} on, until it falls "
                                            "below {:.2f}.",
                                            lane.log_odds, frame.show_lane, frame.hide_lane)};
  if (lane.places > 0) text.back() += fmt::format(" {} of {} places are shown.", lane.shown, lane.places);
  if (lane.observed > 0) text.push_back(frame_of(lane));
  if (lane.verdict == LaneReason::Verdict::shown) text.push_back(direction_of(lane));
  return text;
}

std::string text_of(const DetectionFate& detection) {
  return fate_of(detection) + (detection.in_row ? ", as one of a row of dashes." : ".");
}

}  // namespace laneloom::why
