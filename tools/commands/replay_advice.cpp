#include "commands/replay_advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>
#include <variant>

namespace laneloom::commands {
namespace {

constexpr std::size_t kFramesForALane = 5;  // that must see a lane, by default

/// The most frequent reason among the counters with this prefix, and its count.
std::pair<std::string, std::uint64_t> main_refusal(const Counters& counters, std::string_view prefix) {
  std::pair<std::string, std::uint64_t> most;
  for (const auto& [name, count] : counters.values())
    if (name.starts_with(prefix) && count > most.second) most = {name.substr(prefix.size()), count};
  return most;
}

std::string why_no_map(const ReplayInput& input, const ReplayResult& result) {
  if (input.frames == 0) return "the input has no detections";
  if (input.poses == 0) return "the input has no poses";
  if (const auto [why, count] = main_refusal(result.counters, "poses_refused_"); count == input.poses)
    return fmt::format("all poses were refused, most of them as '{}'", why);
  if (const auto [why, count] = main_refusal(result.counters, "detections_refused_"); count > result.pending)
    return fmt::format("{} of {} frames were refused as '{}'", count, input.frames, why);
  return "there are no poses around the stamps of the frames";
}

std::string why_too_few_frames(const ReplayResult& result) {
  if (result.maps >= kFramesForALane) return {};
  return fmt::format("{} frames were fused, and a lane needs about {} that see its lines", result.maps,
                     kFramesForALane);
}

std::string why_no_marking(const ReplayInput& input, const ReplayResult& result, const MapperConfig& config) {
  if (input.detections == 0) return "no frame has a detection";
  if (input.best_confidence < config.preprocess.min_confidence)
    return fmt::format("no detection is of a confidence of {:g} or more (mapper.preprocess.min_confidence)",
                       config.preprocess.min_confidence);
  if (std::string few = why_too_few_frames(result); !few.empty()) return few;
  return "frames do not agree with one another, or lie outside of mapper.range: see whether the poses are "
         "T_map_body, and the points metres in the body frame";
}

std::string why_no_lane(const ReplayResult& result, const MapperConfig& config) {
  if (std::string few = why_too_few_frames(result); !few.empty()) return few;
  return fmt::format("a lane needs a line or an edge on both sides, {:g} to {:g} m apart (mapper.lane)",
                     config.lane.min_width_m, config.lane.max_width_m);
}

}  // namespace

void ReplayInput::add(const recording::AnyMessage& message) {
  if (std::holds_alternative<VehiclePose>(message)) ++poses;
  const auto* frame = std::get_if<DetectionFrame>(&message);
  if (frame == nullptr) return;
  ++frames;
  detections += frame->detections.size();
  for (const Detection& detection : frame->detections)
    best_confidence = std::max(best_confidence, detection.confidence);
}

std::string advice_on(const ReplayInput& input, const ReplayResult& result, const MapperConfig& config) {
  if (result.maps == 0) return "no map came of it: " + why_no_map(input, result);
  if (result.boundaries == 0) return "no map has a marking: " + why_no_marking(input, result, config);
  if (result.lanes == 0) return "no map has a lane: " + why_no_lane(result, config);
  return {};
}

}  // namespace laneloom::commands
