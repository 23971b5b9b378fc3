#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base/clock.hpp"
#include "base/random_id.hpp"
#include "commands/drive_tables.hpp"
#include "commands/exit_codes.hpp"
#include "commands/lab_commands.hpp"
#include "commands/noise_option.hpp"
#include "commands/options.hpp"
#include "commands/road_list.hpp"
#include "commands/stop_signal.hpp"
#include "config/config_file.hpp"
#include "drive/closed_loop.hpp"
#include "drive/dds_map_service.hpp"
#include "experiment/parallel.hpp"

namespace laneloom::commands {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr std::chrono::seconds kPatience{10};

struct DriveOptions {
  RoadList roads;
  NoiseOption noise;
  double duration_s = 120.0;
  double km = 0.0;
  std::string config, preset;
  DdsConfig dds;
  bool over_dds = false;
  bool by_published_way = false;
  bool require_lane = false;
  bool json = false;
};

bool is_over(const DriveOptions& options, const drive::ClosedLoop& loop) {
  return options.km > 0.0 ? loop.driven_m() >= 1000.0 * options.km : loop.time_s() >= options.duration_s;
}

drive::ClosedLoopSpec loop_spec(const experiment::DriveSpec& drive, const DriveOptions& options) {
  return {.noise = drive.noise,
          .seed = drive.seed,
          .speed_mps = options.roads.speed_mps,
          .drift = drive.drift,
          .traffic = drive.traffic,
          .by_published_way = options.by_published_way};
}

Config read_config(const DriveOptions& options) {
  const Config config = config::resolve_config(options.config, options.preset);
  config::validate(config);
  return config;
}

std::vector<DriveResult> drive_offline(const std::vector<experiment::DriveSpec>& drives,
                                       const DriveOptions& options) {
  const Config config = read_config(options);
  std::vector<DriveResult> results(drives.size());
  experiment::in_parallel(drives.size(), [&](std::size_t i) {
    drive::LocalMapService service(config);
    drive::ClosedLoop loop(*drives[i].road, loop_spec(drives[i], options), service);
    while (!is_over(options, loop) && !stop_requested()) loop.step();
    results[i] = {drives[i].road->name, drives[i].seed, loop.score()};
  });
  return results;
}

[[noreturn]] void nobody_heard(const char* why) {
  fmt::print(stderr, "laneloom: {}\n", why);
  end_with(kNobodyHeard);
}

void connect(const drive::DdsMapService& service) {
  const auto deadline = SteadyClock::now() + kPatience;
  while (!service.connected() && SteadyClock::now() < deadline) {
    if (!sleep_until(SteadyClock::now() + std::chrono::milliseconds(20))) return;
  }
  if (!service.connected()) nobody_heard("no service takes part");
  sleep_until(SteadyClock::now() + kDiscovery);
}

std::vector<DriveResult> drive_over_dds(const std::vector<experiment::DriveSpec>& drives,
                                        const DriveOptions& options) {
  if (drives.size() != 1) throw std::runtime_error("over DDS it is one road with one seed");
  drive::DdsMapService service(options.dds);
  connect(service);
  drive::ClosedLoopSpec spec = loop_spec(drives.front(), options);
  spec.start_ns = system_now_ns();
  spec.session_id = random_id();
  drive::ClosedLoop loop(*drives.front().road, spec, service);
  for (auto due = SteadyClock::now(); !is_over(options, loop) && sleep_until(due);
       due += std::chrono::milliseconds(10))
    loop.step();
  if (service.received() == 0) nobody_heard("no map came");
  return {{drives.front().road->name, drives.front().seed, loop.score()}};
}

void drive(const DriveOptions& options) {
  catch_stop_signals();
  const std::vector<experiment::DriveSpec> drives = options.roads.drives({options.noise.profile()});
  const auto start = SteadyClock::now();
  const std::vector<DriveResult> results =
      options.over_dds ? drive_over_dds(drives, options) : drive_offline(drives, options);
  if (options.json) {
    fmt::print("{}\n", drive_json(results).dump());
  } else {
    fmt::print("{}{:.1f} s spent\n", drive_table(results),
               std::chrono::duration<double>(SteadyClock::now() - start).count());
  }
  const bool left = std::ranges::any_of(
      results, [](const DriveResult& result) { return !result.score.departures.empty(); });
  if (options.require_lane && left) end_with(kFoundWrong);
}

}  // namespace

void add_drive(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "drive", "Steers a simulated vehicle by the map alone, and says how well it keeps its lane");
  command->footer(
      "Exit code: 2 the vehicle left its lane (--require-lane); 3 no service is there, or no map came "
      "(--dds).");
  const auto options = std::make_shared<DriveOptions>();
  add_roads(*command, options->roads);
  command->add_option("--speed", options->roads.speed_mps, "Greatest speed of the vehicle in m/s")
      ->check(within(1.0, 40.0))
      ->capture_default_str();
  add_noise(*command, options->noise);
  add_traffic(*command, options->roads.traffic);
  auto* duration = command->add_option("--duration", options->duration_s, "Simulated seconds per drive")
                       ->check(positive_seconds())
                       ->capture_default_str();
  command->add_option("--km", options->km, "Kilometres per drive, instead")
      ->check(within(1e-3, 1e6))
      ->excludes(duration);
  auto* config = command->add_option("--config", options->config, "Configuration file");
  auto* preset = command->add_option("--preset", options->preset, "Range, and alpha_n of the voxel method")
                     ->check(CLI::IsMember(config::preset_names()));
  auto* dds =
      command->add_flag("--dds", options->over_dds, "Drive in real time, by the map of a running laneloomd")
          ->excludes(config)
          ->excludes(preset);
  for (CLI::Option* option : add_dds(*command, options->dds)) option->needs(dds);
  command->add_flag("--published-way", options->by_published_way,
                    "Follow the way of each map, and tell the service the next turn");
  command->add_flag("--require-lane", options->require_lane, "Fail if the vehicle leaves its lane");
  command->add_flag("--json", options->json, "One JSON object");
  command->callback([options] { drive(*options); });
}

}  // namespace laneloom::commands
