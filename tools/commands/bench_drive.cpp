#include "commands/bench_drive.hpp"

#include "commands/noise_option.hpp"
#include "commands/options.hpp"
#include "config/config_file.hpp"
#include "simulation/scenarios.hpp"

namespace laneloom::commands {

experiment::DriveSpec BenchDrive::spec() const {
  return {.road = std::make_shared<const simulation::Road>(simulation::make_scenario(scenario, speed_mps)),
          .noise = simulation::noise_profile(noise),
          .seed = seed,
          .duration_s = duration_s};
}

MapperConfig BenchDrive::mapper_config() const {
  const Config read = config::resolve_config(config, preset);
  config::validate(read);
  return read.mapper;
}

void add_bench_road(CLI::App& command, BenchDrive& drive) {
  command.add_option("--scenario", drive.scenario, "A built-in road")
      ->check(CLI::IsMember(simulation::scenario_names()))
      ->capture_default_str();
  command.add_option("--noise", drive.noise, "Noise profile of the detections")
      ->check(noise_name())
      ->capture_default_str();
  command.add_option("--speed", drive.speed_mps, "Speed of the vehicle in m/s")
      ->check(within(0.1, 60.0))
      ->capture_default_str();
  command.add_option("--duration", drive.duration_s, "Seconds that are measured")
      ->check(within(0.1, 86'400.0))
      ->capture_default_str();
}

void add_bench_drive(CLI::App& command, BenchDrive& drive) {
  add_bench_road(command, drive);
  command.add_option("--seed", drive.seed, "Seed of the noise")->capture_default_str();
  command.add_option("--preset", drive.preset, "Range, and alpha_n of the voxel method")
      ->check(CLI::IsMember(config::preset_names()))
      ->capture_default_str();
  command.add_option("--config", drive.config, "Configuration file");
}

}  // namespace laneloom::commands
