#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

#include "experiment/drive_simulation.hpp"
#include "laneloom/config.hpp"

namespace laneloom::commands {

/// A drive over a built-in road, and the configuration that it is mapped with: options of the benchmarks.
struct BenchDrive {
  std::string scenario = "town";
  std::string noise = "inhouse";
  std::string preset = "inhouse";
  std::string config;  ///< configuration file; empty: the default configuration
  double speed_mps = 10.0;
  double duration_s = 60.0;
  std::uint64_t seed = 1;

  experiment::DriveSpec spec() const;
  /// Throws ConfigError.
  MapperConfig mapper_config() const;
};

/// Adds --scenario, --noise, --speed and --duration.
void add_bench_road(CLI::App& command, BenchDrive& drive);
/// Adds these, --seed, --preset and --config.
void add_bench_drive(CLI::App& command, BenchDrive& drive);

}  // namespace laneloom::commands
