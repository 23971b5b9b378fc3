#include "why/reason_history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "base/seconds.hpp"

namespace laneloom::why {
namespace {

constexpr double kSpan_s = 3.0;         // of what is told of all lines and lanes
constexpr double kRemembered_s = 10.0;  // of the lines that a lane lay on, which end before it

template <class Reason>
const Reason* find(const std::vector<Reason>& reasons, ElementId id) {
  const auto found = std::ranges::find(reasons, id, &Reason::id);
  return found == reasons.end() ? nullptr : &*found;
}

/// A reason with its frame. Null: there is none.
template <class Reason>
struct Found {
  const Reason* reason = nullptr;
  const FrameReasons* frame = nullptr;
};

/// The newest reason of an id. `list` is where a frame has it.
template <class Reason>
Found<Reason> newest(const std::deque<FrameReasons>& frames, std::vector<Reason> FrameReasons::*list,
                     ElementId id) {
  for (auto frame = frames.rbegin(); frame != frames.rend(); ++frame)
    if (const Reason* reason = find((*frame).*list, id)) return {reason, &*frame};
  return {};
}

/// Says how long ago a frame was, before the text about it.
void put_age(const FrameReasons& frame, const FrameReasons& last, std::vector<std::string>& text) {
  if (const double ago_s = seconds(last.stamp_ns - frame.stamp_ns); ago_s > 0.0)
    text.insert(text.begin(), fmt::format("This was {:.1f} s ago.", ago_s));
}

nlohmann::json entry(std::vector<std::string> text, double log_odds) {
  return {{"text", std::move(text)}, {"log_odds", std::round(log_odds * 1e3) / 1e3}};
}

void append(std::vector<std::string> from, std::vector<std::string>& to) {
  std::ranges::move(from, std::back_inserter(to));
}

}  // namespace

void ReasonHistory::update_begins() { now_ = {}; }

void ReasonHistory::stage_done(Stage stage) {
  if (stage != Stage::way || now_.stamp_ns == 0) return;
  if (now_.repeats && !frames_.empty()) {
    frames_.back().stamp_ns = now_.stamp_ns;
    frames_.back().detections = std::move(now_.detections);
    return;
  }
  frames_.push_back(std::move(now_));
  while (seconds(frames_.back().stamp_ns - frames_.front().stamp_ns) > kRemembered_s) frames_.pop_front();
}

Sightings ReasonHistory::sightings_of(ElementId id) const {
  Sightings sightings;
  const auto first = first_lately();
  for (auto frame = first; frame != frames_.end(); ++frame, ++sightings.of) {
    const LineReason* line = find(frame->lines, id);
    if (line != nullptr && !line->detections.empty()) ++sightings.frames;
  }
  sightings.span_s = seconds(frames_.back().stamp_ns - first->stamp_ns);
  return sightings;
}

std::deque<FrameReasons>::const_iterator ReasonHistory::first_lately() const {
  const auto is_lately = [&](const FrameReasons& frame) {
    return seconds(frames_.back().stamp_ns - frame.stamp_ns) <= kSpan_s;
  };
  return std::ranges::find_if(frames_, is_lately);
}

std::vector<std::string> ReasonHistory::of_line(ElementId id) const {
  const auto [line, frame] = newest(frames_, &FrameReasons::lines, id);
  if (line == nullptr) return {};
  std::vector<std::string> text = text_of(*line, *frame, sightings_of(id));
  put_age(*frame, frames_.back(), text);
  return text;
}

std::vector<std::string> ReasonHistory::terms_of_lane(ElementId id) const {
  const auto [lane, frame] = newest(frames_, &FrameReasons::lanes, id);
  if (lane == nullptr) return {};
  std::vector<std::string> text = text_of(*lane, *frame);
  put_age(*frame, frames_.back(), text);
  return text;
}

std::vector<std::string> ReasonHistory::of_lane(ElementId id) const {
  std::vector<std::string> text = terms_of_lane(id);
  append(lines_of_lane(id, {}), text);
  return text;
}

/// The reasons that are known of the lines on the left and right of a lane, but for those that are `told`.
std::vector<std::string> ReasonHistory::lines_of_lane(ElementId id, const std::set<ElementId>& told) const {
  std::vector<std::string> text;
  const LaneReason* lane = newest(frames_, &FrameReasons::lanes, id).reason;
  if (lane == nullptr) return text;
  for (const auto& [side, boundaries] : {std::pair("left", &lane->left), std::pair("right", &lane->right)})
    for (const ElementId boundary : *boundaries) {
      std::vector<std::string> line = of_line(boundary);
      if (line.empty() || told.contains(boundary)) continue;
      line.front() = fmt::format("On its {}: ", side) + line.front();
      append(std::move(line), text);
    }
  return text;
}

std::vector<std::string> ReasonHistory::of_lane(const Lane& lane) const {
  std::vector<std::string> text = terms_of_lane(lane.id);
  std::set<ElementId> told;
  for (const Side side : {Side::left, Side::right})
    for (const Border& border : lane.borders(side)) {
      const std::string place =
          fmt::format("{} side, {:.0f} to {:.0f} m: ", side == Side::left ? "Left" : "Right",
                      border.range.from_m, border.range.to_m);
      std::vector<std::string> line = of_line(border.boundary);
      told.insert(border.boundary);
      if (border.boundary == kNoElement)
        text.push_back(place + "nothing was seen there; the lane was concluded.");
      else if (line.empty())
        text.push_back(place + fmt::format("boundary {} is concluded, not seen.", border.boundary));
      else
        line.front() = place + line.front();
      append(std::move(line), text);
    }
  append(lines_of_lane(lane.id, told), text);
  return text;
}

std::string ReasonHistory::of_detection(std::size_t number) const {
  if (frames_.empty() || number >= frames_.back().detections.size()) return {};
  return text_of(frames_.back().detections[number]);
}

std::vector<std::string> ReasonHistory::of(ElementId id, const LocalMap& map) const {
  const auto lane = std::ranges::find(map.lanes, id, &Lane::id);
  if (lane != map.lanes.end()) return of_lane(*lane);
  std::vector<std::string> text = of_line(id);
  return text.empty() ? of_lane(id) : text;
}

nlohmann::json ReasonHistory::to_json(const LocalMap& map) const {
  if (frames_.empty() || frames_.back().stamp_ns != map.stamp_ns) return {};
  const FrameReasons& frame = frames_.back();
  nlohmann::json out{{"publish", frame.publish},
                     {"confirm", frame.confirm},
                     {"show_lane", frame.show_lane},
                     {"hide_lane", frame.hide_lane}};
  std::map<ElementId, double> lines;             // log odds, also of those that ended lately
  std::map<ElementId, const LaneReason*> lanes;  // likewise
  const auto put = [&](const LineReason& line) { lines[line.id] = line.by_stations + line.by_belief; };
  for (auto earlier = first_lately(); earlier != frames_.end(); ++earlier) {
    std::ranges::for_each(earlier->lines, put);
    for (const LaneReason& lane : earlier->lanes) lanes[lane.id] = &lane;
  }
  for (const auto& [id, lane] : lanes)
    for (const auto* ids : {&lane->left, &lane->right})
      for (const ElementId line : *ids)
        if (const LineReason* ended = newest(frames_, &FrameReasons::lines, line).reason) put(*ended);
  for (const auto& [id, log_odds] : lines) out["lines"][std::to_string(id)] = entry(of_line(id), log_odds);
  for (const auto& [id, reason] : lanes) {
    const auto lane = std::ranges::find(map.lanes, id, &Lane::id);
    nlohmann::json& one = out["lanes"][std::to_string(id)] =
        entry(lane != map.lanes.end() ? of_lane(*lane) : of_lane(id), reason->log_odds);
    one["lines"] = reason->left;
    for (const ElementId line : reason->right) one["lines"].push_back(line);
  }
  for (const DetectionFate& detection : frame.detections)
    out["detections"].push_back({{"text", text_of(detection)}, {"lines", detection.lines}});
  return out;
}

}  // namespace laneloom::why
