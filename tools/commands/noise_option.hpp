#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "simulation/noise_profile.hpp"

namespace laneloom::commands {

/// The name of a noise profile: a known one, or random:SEED.
CLI::Validator noise_name();

/// Options of several commands on how simulated detections differ from the truth.
struct NoiseOption {
  std::string name = "inhouse";
  bool without_view = false;

  simulation::NoiseProfile profile() const;
};

/// Adds --noise and --no-field-of-view.
void add_noise(CLI::App& command, NoiseOption& noise);
/// Adds --traffic, which takes a profile or one of `others`.
void add_traffic(CLI::App& command, std::string& traffic, const std::vector<std::string>& others = {});
/// Adds --no-field-of-view alone.
void add_without_view(CLI::App& command, bool& without_view);

}  // namespace laneloom::commands
