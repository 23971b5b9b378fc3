#include "why/reason_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

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

std::string lines_of(const DetectionFate& detection) {
  return fmt::format("line{} {}", detection.lines.size() == 1 ? "" : "s", fmt::join(detection.lines, ", "));
}

std::string fate_of(const DetectionFate& detection) {
  switch (detection.rule) {
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
  const std::string now = line.detections.empty()
                              ? "No detection of this frame observes it"
                              : fmt::format("Detection {} observes it", fmt::join(line.detections, ", "));
  text.push_back(fmt::format("{}; in the last {:.1f} s, {} of {} frames did.", now, lately.span_s,
                             lately.frames, lately.of));
  return text;
}

std::string text_of(const DetectionFate& detection) {
  return fate_of(detection) + (detection.in_row ? ", as one of a row of dashes." : ".");
}

}  // namespace laneloom::why
