#include "experiment/experiment.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <stdexcept>

#include "commands/lab_commands.hpp"
#include "commands/noise_option.hpp"
#include "commands/road_list.hpp"
#include "config/config_file.hpp"
#include "experiment/paired_table.hpp"
#include "experiment/results_table.hpp"
#include "experiment/spread_table.hpp"

namespace laneloom::commands {
namespace {

struct ExperimentOptions {
  RoadList roads;
  std::vector<std::string> noises{"inhouse"};
  bool without_view = false;
  std::string preset = "inhouse";
  std::vector<std::string> configs;
  std::string peer;
  bool oracle = false;
  bool spread = false;
};

/// Reads a configuration from "FILE" or "FILE:key=value,key=value". The file "default" is the built-in
/// configuration.
experiment::NamedConfig read_config(const std::string& spec, const std::string& preset) {
  const auto colon = spec.find(':');
  const std::string file = spec.substr(0, colon);
  experiment::NamedConfig named{spec, config::resolve_config(file == "default" ? "" : file, preset)};
  for (std::size_t from = colon; from != std::string::npos;) {
    const std::size_t to = spec.find(',', ++from);
    config::set_value(named.config, spec.substr(from, to - from));
    from = to;
  }
  config::validate(named.config);
  return named;
}

void experiment(const ExperimentOptions& options) {
  experiment::ExperimentSpec spec;
  std::vector<simulation::NoiseProfile> noises;
  for (const std::string& name : options.noises)
    noises.push_back(NoiseOption{.name = name, .without_view = options.without_view}.profile());
  spec.drives = options.roads.drives(noises);
  for (const std::string& config : options.configs)
    spec.configs.push_back(read_config(config, options.preset));
  if (!options.peer.empty()) spec.peer = experiment::Peer{options.peer, options.preset};
  spec.oracle = options.oracle || options.spread;
  Config ranged;
  config::apply_preset(ranged, options.preset);
  spec.range = ranged.mapper.range;
  const std::vector<experiment::DriveResults> results = run(spec);
  fmt::print("{}", results_table(sum(results)));
  if (options.spread) fmt::print("\n{}", spread_table(spec.drives, results));
  if (spec.configs.size() > 1) fmt::print("\n{}", paired_table(results, spec.configs.size()));
}

}  // namespace

void add_experiment(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("experiment", "Rates detections, configurations, a peer and an oracle on drives");
  const auto options = std::make_shared<ExperimentOptions>();
  add_road_list(*command, options->roads);
  command
      ->add_option("--noise", options->noises,
                   "Noise profile of the detections; every road is seen with each")
      ->delimiter(',')
      ->check(noise_name())
      ->capture_default_str();
  add_without_view(*command, options->without_view);
  add_traffic(*command, options->roads.traffic);
  command->add_option("--preset", options->preset, "Range that is rated, and alpha_n of the voxel method")
      ->check(CLI::IsMember(config::preset_names()))
      ->capture_default_str();
  command->add_option("--config", options->configs,
                      "Configuration, as FILE or FILE:section.key=value,…; \"default\" is the built-in one");
  command->add_option("--peer", options->peer, "Another program that maps JSON lines to JSON lines");
  command->add_flag("--oracle", options->oracle,
                    "Also rate the mean of all detections of each marking, without wrong associations");
  command->add_flag(
      "--spread", options->spread,
      "Also print mean, worst decile and worst of the single drives, and how far they are on the way from "
      "single detections to the oracle");
  command->callback([options] { experiment(*options); });
}

}  // namespace laneloom::commands
