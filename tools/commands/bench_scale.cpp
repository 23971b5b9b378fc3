#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "bench/scale.hpp"
#include "commands/bench.hpp"
#include "commands/bench_drive.hpp"
#include "commands/time_table.hpp"

namespace laneloom::commands {
namespace {

using nlohmann::json;

constexpr std::array<std::size_t, 5> kFactors{1, 2, 4, 8, 16};

struct BenchScaleOptions {
  BenchDrive drive;
  std::size_t minutes = 60;
  bool as_json = false;
};

json cost_json(const bench::MapperCost& cost) {
  return {{"ms", to_json(cost.update())},
          {"stages", to_json(cost.stages)},
          {"markings", cost.markings_per_map()},
          {"allocations_per_frame", cost.allocations_per_update()},
          {"heap_mb", static_cast<double>(cost.heap_bytes) / bench::kBytesPerMB},
          {"peak_heap_mb", static_cast<double>(cost.peak_heap_bytes) / bench::kBytesPerMB}};
}

/// A row of the result. Its subject is under `key`.
json row(const char* key, std::size_t value, const bench::MapperCost& cost) {
  json result = cost_json(cost);
  result[key] = value;
  return result;
}

json by_detections(const BenchScaleOptions& options, const std::vector<experiment::SimulatedFrame>& frames) {
  const MapperConfig config = options.drive.mapper_config();
  json rows = json::array();
  for (const std::size_t copies : kFactors) {
    std::vector<experiment::SimulatedFrame> more = frames;
    for (experiment::SimulatedFrame& frame : more)
      frame.record.frame = bench::multiplied(frame.record.frame, copies, config.range.side_max_m);
    rows.push_back(row("factor", copies, bench::measure(config, more)));
  }
  return rows;
}

json by_range(const BenchScaleOptions& options) {
  json rows = json::array();
  for (const std::size_t factor : {1U, 2U, 4U, 8U}) {
    const auto times = static_cast<double>(factor);
    MapperConfig config = options.drive.mapper_config();
    config.range = bench::scaled(config.range, times);
    experiment::DriveSpec drive = options.drive.spec();
    drive.view = bench::scaled(drive.view, times);
    rows.push_back(row("factor", factor, bench::measure(config, simulate(drive))));
  }
  return rows;
}

/// The cost of a drive, minute by minute.
json by_time(const BenchScaleOptions& options, const experiment::DriveSpec& drive) {
  json rows = json::array();
  bench::drive_minutes(options.drive.mapper_config(), drive, options.minutes,
                       [&](const bench::MinuteCost& minute) {
                         rows.push_back(row("minute", minute.minute, minute.cost));
                         rows.back()["rss_mb"] = minute.rss_mb;
                       });
  return rows;
}

json standing_still(const BenchScaleOptions& options) {
  experiment::DriveSpec drive = options.drive.spec();
  drive.road = std::make_shared<const simulation::Road>(
      bench::standing(*drive.road, 0.5 * drive.road->drive.duration_s()));
  return by_time(options, drive);
}

json by_vehicles(const BenchScaleOptions& options, const std::vector<experiment::SimulatedFrame>& frames) {
  json rows = json::array();
  for (const std::size_t vehicles : kFactors)
    rows.push_back({{"vehicles", vehicles},
                    {"ms", to_json(bench::time_vehicles(options.drive.mapper_config(), frames, vehicles))}});
  return rows;
}

void print_costs(const char* title, const char* key, const json& rows) {
  fmt::print("\n{:<10} {:>9} {:>9} {:>9} {:>9} {:>12} {:>9} {:>9}\n", title, "mean ms", "p99 ms", "max ms",
             "markings", "allocations", "heap MB", "peak MB");
  for (const json& cost : rows) {
    const json& ms = cost.at("ms");
    fmt::print("{:<10} {:>9.3f} {:>9.3f} {:>9.3f} {:>9.1f} {:>12.0f} {:>9.2f} {:>9.2f}\n",
               cost.at(key).get<std::size_t>(), ms.at("mean").get<double>(), ms.at("p99").get<double>(),
               ms.at("max").get<double>(), cost.at("markings").get<double>(),
               cost.at("allocations_per_frame").get<double>(), cost.at("heap_mb").get<double>(),
               cost.at("peak_heap_mb").get<double>());
  }
}

/// The rows of the first two minutes and the last two.
json ends(const json& minutes) {
  json rows = json::array();
  for (std::size_t i = 0; i < minutes.size(); ++i)
    if (i < 2 || i + 2 >= minutes.size()) rows.push_back(minutes[i]);
  return rows;
}

void print(const json& result) {
  print_costs("detections", "factor", result.at("detections"));
  print_costs("range", "factor", result.at("range"));
  print_costs("driving", "minute", ends(result.at("driving")));
  print_costs("standing", "minute", ends(result.at("standing")));
  fmt::print("\n{:<10} {:>9} {:>9}\n", "vehicles", "mean ms", "p99 ms");
  for (const json& row : result.at("vehicles"))
    fmt::print("{:<10} {:>9.3f} {:>9.3f}\n", row.at("vehicles").get<std::size_t>(),
               row.at("ms").at("mean").get<double>(), row.at("ms").at("p99").get<double>());
}

void scale(const BenchScaleOptions& options) {
  json result;
  // This comes first, while this process has little else in memory.
  result["driving"] = by_time(options, options.drive.spec());
  result["standing"] = standing_still(options);
  const std::vector<experiment::SimulatedFrame> frames = simulate(options.drive.spec());
  if (frames.empty()) throw std::runtime_error("the drive has no frame");
  result["detections"] = by_detections(options, frames);
  result["range"] = by_range(options);
  result["vehicles"] = by_vehicles(options, frames);
  options.as_json ? fmt::print("{}\n", result.dump()) : print(result);
}

}  // namespace

void add_bench_scale(CLI::App& bench) {
  CLI::App* command = bench.add_subcommand(
      "scale",
      "Measures how the mapper's time and memory grow with detections, range, duration and vehicles");
  const auto options = std::make_shared<BenchScaleOptions>();
  add_bench_drive(*command, options->drive);
  command->add_option("--minutes", options->minutes, "Simulated minutes of driving round, and of standing")
      ->check(CLI::Range(1, 1440))
      ->capture_default_str();
  command->add_flag("--json", options->as_json, "One JSON object");
  command->callback([options] { scale(*options); });
}

}  // namespace laneloom::commands
