#include "commands/replay_report.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>
#include <variant>

#include "commands/time_table.hpp"
#include "config/network_profile.hpp"
#include "io/json_text.hpp"
#include "io/text_file.hpp"
#include "mapping/trails/vehicles.hpp"

namespace laneloom::commands {
namespace {

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

void print_times(const support::StageTimer& timer) {
  print_time_header("milliseconds");
  print_stage_rows(timer);
  print_time_row("total", timer.total());
}

double recorded_s(const ReplayResult& result) {
  return static_cast<double>(result.last_ns - result.first_ns) * 1e-9;
}

double per_map(std::size_t count, const ReplayResult& result) {
  return result.maps > 0 ? static_cast<double>(count) / static_cast<double>(result.maps) : 0.0;
}

nlohmann::json as_json(const ReplayResult& result) {
  nlohmann::json json{{"config", result.name},
                      {"frames", result.maps},
                      {"hash", result.hash},
                      {"recorded_s", recorded_s(result)},
                      {"elapsed_s", result.elapsed_s},
                      {"peak_rss_mb", peak_memory_mb()},
                      {"frames_without_pose", result.pending},
                      {"counters", result.counters.values()},
                      {"per_map",
                       {{"boundaries", per_map(result.boundaries, result)},
                        {"lanes", per_map(result.lanes, result)},
                        {"linkages", per_map(result.linkages, result)}}}};
  json["ms"] = to_json(result.timer);
  json["ms"]["total"] = to_json(result.timer.total());
  return json;
}

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

std::string why_no_lane(const ReplayResult& result) {
  if (std::string few = why_too_few_frames(result); !few.empty()) return few;
  return "a lane needs a line or an edge on both sides, as far apart as the limits in mapper.lane say";
}

/// Of messages of which most were refused, how many were, and why.
std::string why_few_maps(const Counters& counters, const std::string& subject, std::size_t count) {
  const auto [why, refused] = main_refusal(counters, subject + "_refused_");
  if (2 * refused <= count) return {};
  const std::string_view messages = subject == "objects" ? "messages of " : "";
  return fmt::format("{} of {} {}{} were refused as '{}'", refused, count, messages, subject, why);
}

/// Of objects that move and leave no trails, why they do not.
std::string why_no_trail(const Counters& counters) {
  const trails::MovingObjects moving{.believed = counters["objects_believed"],
                                     .without_heading = counters["objects_without_heading"],
                                     .doubted = counters["objects_doubted"]};
  if (!moving.leave_no_trail()) return {};
  return fmt::format(
      "of {} moving objects none left a trail: {} have no heading, {} are of unknown kind or not sure "
      "(existence_probability, position_stddev_m)",
      moving.useless(), moving.without_heading, moving.doubted);
}

std::string idle_profile(const std::set<std::string>& sources, const std::string& profile_file) {
  for (const auto& [source, profile] : config::load_network_profiles(profile_file))
    if (!sources.contains(source))
      return fmt::format("the profile of the source \"{}\" is not used: no frame has this source", source);
  return {};
}

}  // namespace

void ReplayInput::add(const recording::AnyMessage& message) {
  if (std::holds_alternative<VehiclePose>(message)) ++poses;
  if (std::holds_alternative<TrackedObjects>(message)) ++objects;
  const auto* frame = std::get_if<DetectionFrame>(&message);
  if (frame == nullptr) return;
  ++frames;
  detections += frame->detections.size();
  sources.insert(frame->source);
  for (const Detection& detection : frame->detections)
    best_confidence = std::max(best_confidence, detection.confidence);
}

std::string advice_on(const ReplayInput& input, const ReplayResult& result, const MapperConfig& config) {
  if (result.maps == 0) return "no map came of it: " + why_no_map(input, result);
  if (result.boundaries == 0) return "no map has a marking: " + why_no_marking(input, result, config);
  if (result.lanes == 0) return "no map has a lane: " + why_no_lane(result);
  if (std::string few = why_few_maps(result.counters, "poses", input.poses); !few.empty()) return few;
  if (std::string few = why_few_maps(result.counters, "detections", input.frames); !few.empty()) return few;
  if (std::string few = why_few_maps(result.counters, "objects", input.objects); !few.empty()) return few;
  if (std::string none = why_no_trail(result.counters); !none.empty()) return none;
  return idle_profile(input.sources, config.fusion.profile_file);
}

void ReplayResult::add(const LocalMap& map) {
  if (maps++ == 0) first_ns = map.stamp_ns;
  last_ns = map.stamp_ns;
  boundaries += map.boundaries.size();
  lanes += map.lanes.size();
  linkages += map.linkages.size();
}

void ReplayResult::add_live(const recording::AnyMessage& message) {
  if (const auto* map = std::get_if<PublishedMap>(&message)) comparison.add_live(*map);
  if (const auto* markings = std::get_if<RoadMarkings>(&message)) comparison.add_live(*markings);
}

void print_result(const ReplayResult& result) {
  print_times(result.timer);
  for (const auto& [counter, count] : result.counters.values()) {
    if (counter.find("_refused_") != std::string::npos || counter.find("_dropped_") != std::string::npos ||
        counter == "map_resets" || counter == "pose_jumps")
      fmt::print("{} {}\n", counter, count);
  }
  if (result.pending > 0) fmt::print("frames_without_pose {}\n", result.pending);
  fmt::print("{} frames of {:.1f} s in {:.2f} s ({:.0f} times real time)\nhash {}\n", result.maps,
             recorded_s(result), result.elapsed_s,
             result.elapsed_s > 0.0 ? recorded_s(result) / result.elapsed_s : 0.0, result.hash);
}

void print_comparison(const std::vector<ReplayResult>& results) {
  fmt::print("\n{:<28} {:>7} {:>9} {:>9} {:>11} {:>7} {:>9}  {}\n", "configuration", "frames", "mean ms",
             "p99 ms", "boundaries", "lanes", "linkages", "maps");
  for (const ReplayResult& result : results) {
    const TimeSummary time = result.timer.total();
    fmt::print("{:<28} {:>7} {:>9.3f} {:>9.3f} {:>11.2f} {:>7.2f} {:>9.2f}  {}\n", result.name, result.maps,
               time.mean_ms, time.p99_ms, per_map(result.boundaries, result), per_map(result.lanes, result),
               per_map(result.linkages, result),
               &result == &results.front()           ? "-"
               : result.hash == results.front().hash ? "the same"
                                                     : "others");
  }
}

void write_report(const std::string& path, const std::vector<ReplayResult>& results) {
  nlohmann::json report;
  if (results.size() == 1) {
    report = as_json(results.front());
  } else {
    for (const ReplayResult& result : results) report["configurations"].push_back(as_json(result));
  }
  io::write_text(path, io::json_text(report, 2) + "\n");
}

}  // namespace laneloom::commands
