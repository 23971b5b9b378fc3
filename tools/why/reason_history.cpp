#include "why/reason_history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "base/seconds.hpp"

namespace laneloom::why {
namespace {

constexpr double kSpan_s = 3.0;

const LineReason* find(const FrameReasons& frame, ElementId id) {
  const auto found = std::ranges::find(frame.lines, id, &LineReason::id);
  return found == frame.lines.end() ? nullptr : &*found;
}

void append(std::vector<std::string> from, std::vector<std::string>& to) {
  std::ranges::move(from, std::back_inserter(to));
}

}  // namespace

void ReasonHistory::update_begins() { now_ = {}; }

void ReasonHistory::stage_done(Stage stage) {
  if (stage != Stage::polylines || now_.stamp_ns == 0) return;
  frames_.push_back(std::move(now_));
  while (seconds(frames_.back().stamp_ns - frames_.front().stamp_ns) > kSpan_s) frames_.pop_front();
}

Sightings ReasonHistory::sightings_of(ElementId id) const {
  Sightings sightings{.of = frames_.size()};
  for (const FrameReasons& frame : frames_) {
    const LineReason* line = find(frame, id);
    if (line != nullptr && !line->detections.empty()) ++sightings.frames;
  }
  sightings.span_s = seconds(frames_.back().stamp_ns - frames_.front().stamp_ns);
  return sightings;
}

std::vector<std::string> ReasonHistory::of_line(ElementId id) const {
  for (auto frame = frames_.rbegin(); frame != frames_.rend(); ++frame) {
    const LineReason* line = find(*frame, id);
    if (line == nullptr) continue;
    std::vector<std::string> text = text_of(*line, *frame, sightings_of(id));
    if (const double ago_s = seconds(frames_.back().stamp_ns - frame->stamp_ns); ago_s > 0.0)
      text.insert(text.begin(), fmt::format("This was {:.1f} s ago.", ago_s));
    return text;
  }
  return {};
}

std::vector<std::string> ReasonHistory::of_lane(const Lane& lane) const {
  std::vector<std::string> text;
  for (const Side side : {Side::left, Side::right})
    for (const Border& border : lane.borders(side)) {
      const std::string place =
          fmt::format("{} side, {:.0f} to {:.0f} m: ", side == Side::left ? "Left" : "Right",
                      border.range.from_m, border.range.to_m);
      std::vector<std::string> line = of_line(border.boundary);
      if (border.boundary == kNoElement)
        text.push_back(place + "nothing was seen there; the lane was concluded.");
      else if (line.empty())
        text.push_back(place + fmt::format("boundary {} is concluded, not seen.", border.boundary));
      else
        line.front() = place + line.front();
      append(std::move(line), text);
    }
  return text;
}

std::string ReasonHistory::of_detection(std::size_t number) const {
  if (frames_.empty() || number >= frames_.back().detections.size()) return {};
  return text_of(frames_.back().detections[number]);
}

std::vector<std::string> ReasonHistory::of(ElementId id, const LocalMap& map) const {
  const auto lane = std::ranges::find(map.lanes, id, &Lane::id);
  return lane != map.lanes.end() ? of_lane(*lane) : of_line(id);
}

nlohmann::json ReasonHistory::to_json(const LocalMap& map) const {
  if (frames_.empty() || frames_.back().stamp_ns != map.stamp_ns) return {};
  const FrameReasons& frame = frames_.back();
  nlohmann::json out{{"publish", frame.publish}, {"confirm", frame.confirm}};
  std::map<ElementId, double> lines;  // also those that ended lately
  for (const FrameReasons& earlier : frames_)
    for (const LineReason& line : earlier.lines) lines[line.id] = line.by_stations + line.by_belief;
  for (const auto& [id, log_odds] : lines)
    out["lines"][std::to_string(id)] = {{"text", of_line(id)},
                                        {"log_odds", std::round(log_odds * 1e3) / 1e3}};
  for (const Lane& lane : map.lanes) out["lanes"][std::to_string(lane.id)] = of_lane(lane);
  for (const DetectionFate& detection : frame.detections)
    out["detections"].push_back({{"text", text_of(detection)}, {"lines", detection.lines}});
  return out;
}

}  // namespace laneloom::why
