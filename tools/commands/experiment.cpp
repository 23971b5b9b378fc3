#include "experiment/experiment.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <stdexcept>

#include "commands/commands.hpp"
#include "commands/road_list.hpp"
#include "laneloom/config_file.hpp"

namespace laneloom {
namespace {

struct Options {
  RoadList roads;
  std::string noise = "inhouse";
  std::string preset = "inhouse";
  std::vector<std::string> configs;
  std::string peer;
  bool oracle = false;
};

/// From "FILE" or "FILE:key=value,key=value"; the file "default" is the built-in configuration.
NamedConfig read_config(const std::string& spec, const std::string& preset) {
  const auto colon = spec.find(':');
  const std::string file = spec.substr(0, colon);
  NamedConfig named{spec, file == "default" ? Config{} : load_config(file)};
  apply_preset(named.config, preset);
  for (std::size_t from = colon; from != std::string::npos;) {
    const std::size_t to = spec.find(',', ++from);
    set_value(named.config, spec.substr(from, to - from));
    from = to;
  }
  validate(named.config);
  return named;
}

std::string number(bool known, double value, int decimals) {
  return known ? fmt::format("{:.{}f}", value, decimals) : "-";
}

bool has_confidences(const Trust& trust) {
  std::size_t count = 0;
  for (const CalibrationBin& bin : trust.calibration) count += bin.count;
  return count > 0;
}

void print_header() {
  fmt::print(
      "| | P % | R % | F1 % | ACD m | jitter cm | flicker % | ids/100 m | lanes P/R/F1 % | linkages P/R % | "
      "across P % | directions P/R % | "
      "TOP_ll % | mAP % | 2σ % | ECE | first s | ms p50/p99 |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
}

void print_row(const SubjectResult& result) {
  const Measures& m = result.measures;
  const Score markings = m.score.markings();
  const Score& lanes = m.score.of(LineKind::lane);
  const Stability steady = m.markings_stability();
  const PairScore& linkages = m.topology.linkages;
  const PairScore& across = m.topology.by_kind.at(static_cast<std::size_t>(Linkage::Kind::intersection));
  const PairScore& directions = m.topology.directions;
  const bool times = result.update_ms.count() > 0;
  fmt::print(
      "| {} | {:.1f} | {:.1f} | {:.1f} | {:.3f} | {} | {} | {} | {}/{}/{} | {}/{} | {} | {}/{} | {} | {:.1f} "
      "| {} "
      "| {} | {:.1f} "
      "| {}/{} "
      "|\n",
      result.name, 100 * markings.precision(), 100 * markings.recall(), 100 * markings.f1(), markings.acd_m(),
      number(steady.jitter_m.count() > 0, 100 * steady.jitter_m.mean(), 2),
      number(steady.was_right > 0, 100 * steady.flicker(), 2),
      number(steady.has_ids, 0.1 * steady.id_switches_per_km(), 2),
      number(lanes.predictions > 0, 100 * lanes.precision(), 0),
      number(lanes.predictions > 0, 100 * lanes.recall(), 0),
      number(lanes.predictions > 0, 100 * lanes.f1(), 1),
      number(linkages.published > 0, 100 * linkages.precision(), 0),
      number(linkages.published > 0, 100 * linkages.recall(), 0),
      number(across.published > 0, 100 * across.precision(), 0),
      number(directions.published > 0, 100 * directions.precision(), 1),
      number(directions.published > 0, 100 * directions.recall(), 0),
      number(lanes.predictions > 0, 100 * m.top_ll.value(), 1), 100 * m.average_precision.map(),
      number(m.markings.vertices > 0, 100 * m.markings.within_2_sigma(), 1),
      number(has_confidences(m.markings), m.markings.expected_calibration_error(), 3),
      m.markings.first_appearance_s.quantile(0.5), number(times, result.update_ms.quantile(0.5), 2),
      number(times, result.update_ms.quantile(0.99), 2));
}

void experiment(const Options& options) {
  ExperimentSpec spec;
  spec.drives = options.roads.drives(noise_profile(options.noise));
  for (const std::string& config : options.configs)
    spec.configs.push_back(read_config(config, options.preset));
  if (!options.peer.empty()) spec.peer = Peer{options.peer, options.preset};
  spec.oracle = options.oracle;
  Config ranged;
  apply_preset(ranged, options.preset);
  spec.range = ranged.mapper.range;
  const std::vector<SubjectResult> results = run(spec);
  print_header();
  for (const SubjectResult& result : results) print_row(result);
}

}  // namespace

void add_experiment(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("experiment", "Rates detections, configurations, a peer and an oracle on drives");
  const auto options = std::make_shared<Options>();
  add_road_list(*command, options->roads);
  command->add_option("--noise", options->noise, "How the detections differ from the truth")
      ->check(CLI::IsMember(noise_profile_names()))
      ->capture_default_str();
  command->add_option("--preset", options->preset, "Range that is rated, and alpha_n of the voxel method")
      ->check(CLI::IsMember({"inhouse", "av2"}))
      ->capture_default_str();
  command->add_option("--config", options->configs,
                      "Configuration, as FILE or FILE:section.key=value,…; \"default\" is the built-in one");
  command->add_option("--peer", options->peer, "Another program that maps JSON lines to JSON lines")
      ->check(CLI::ExistingFile);
  command->add_flag("--oracle", options->oracle,
                    "Also the mean of all that was seen of each marking, rightly associated");
  command->callback([options] { experiment(*options); });
}

}  // namespace laneloom
