#include "commands/replay_report.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <nlohmann/json.hpp>
#include <variant>

#include "commands/time_table.hpp"
#include "io/text_file.hpp"

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

}  // namespace

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
  io::write_text(path, report.dump(2) + "\n");
}

}  // namespace laneloom::commands
