#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "commands/commands.hpp"
#include "commands/evaluation_inputs.hpp"
#include "commands/evaluation_plots.hpp"
#include "commands/evaluation_tables.hpp"
#include "commands/options.hpp"
#include "commands/profile_tables.hpp"
#include "commands/score_table.hpp"
#include "evaluation/map_evaluation.hpp"

namespace laneloom {
namespace {

struct Options {
  std::string truth, frames, map, json, plots;
  RangeConfig range;
  double min_confidence = PreprocessConfig{}.min_confidence;
};

using Stamps = std::set<std::int64_t>;

Stamps frame_stamps(const std::string& path) {
  Stamps stamps;
  for_each_frame(
      path, [&](const DetectionFrame& frame, const Eigen::Isometry3d&) { stamps.insert(frame.stamp_ns); });
  return stamps;
}

Stamps map_stamps(const std::string& path) {
  Stamps stamps;
  for_each_map(path, [&](const LocalMap& map) { stamps.insert(map.stamp_ns); });
  return stamps;
}

/// The moments to compare at: those that every given file has.
Stamps common_stamps(const Options& options) {
  if (options.map.empty()) return frame_stamps(options.frames);
  if (options.frames.empty()) return map_stamps(options.map);
  const Stamps frames = frame_stamps(options.frames), maps = map_stamps(options.map);
  Stamps common;
  std::set_intersection(frames.begin(), frames.end(), maps.begin(), maps.end(),
                        std::inserter(common, common.end()));
  if (common.empty()) throw std::runtime_error("detections and maps have no stamp in common");
  return common;
}

MapEvaluation evaluate_detections(const Options& options, const Road& truth, const Stamps& stamps) {
  MapEvaluation evaluation(truth, options.range, Subject::detections);
  for_each_frame(options.frames, [&](const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body) {
    if (stamps.contains(frame.stamp_ns)) evaluation.add(frame, T_map_body, options.min_confidence);
  });
  return evaluation;
}

MapEvaluation evaluate_maps(const Options& options, const Road& truth, const Stamps& stamps) {
  MapEvaluation evaluation(truth, options.range, Subject::maps);
  for_each_map(options.map, [&](const LocalMap& map) {
    if (stamps.contains(map.stamp_ns)) evaluation.add(map);
  });
  return evaluation;
}

void evaluate(const Options& options) {
  const Road truth = load_truth(options.truth);
  const Stamps stamps = common_stamps(options);
  std::vector<NamedScore> scores;
  std::vector<NamedEvaluation> evaluations;
  if (!options.frames.empty()) evaluations.emplace_back("raw", evaluate_detections(options, truth, stamps));
  if (!options.map.empty()) evaluations.emplace_back("fused", evaluate_maps(options, truth, stamps));
  scores.reserve(evaluations.size());
  for (const auto& [who, evaluation] : evaluations) scores.emplace_back(who, evaluation.score());
  fmt::print("{}{} frames, range {:g}..{:g} m, +-{:g} m\n", score_table(scores), stamps.size(),
             options.range.forward_min_m, options.range.forward_max_m, options.range.side_max_m);
  fmt::print("{}{}", evaluation_tables(evaluations), profile_table(evaluations));
  if (!options.plots.empty()) draw_evaluation(evaluations, options.plots);
  if (options.json.empty()) return;
  nlohmann::json json = score_json(scores);
  json.update(evaluation_json(evaluations), true);
  json.update(profile_json(evaluations), true);
  std::ofstream out(options.json);
  out << json.dump(2) << '\n';
  out.close();
  if (!out) throw std::runtime_error(options.json + ": cannot be written");
}

}  // namespace

void add_evaluate(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "evaluate", "How good detections and maps are: precision, recall, stability, lanes, trust");
  const auto options = std::make_shared<Options>();
  command->add_option("--truth", options->truth, "Truth of the road (.json)")->required();
  CLI::Option_group* inputs = command->add_option_group("Inputs", "one or both; then at their common stamps");
  inputs->add_option("--frames", options->frames, "Single detections (.frames.jsonl or .mcap)");
  inputs->add_option("--map", options->map, "Fused maps (.jsonl or .mcap)");
  inputs->require_option(1, 2);
  add_range(*command, options->range);
  command->add_option("--min-confidence", options->min_confidence, "Of the single detections that count")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command->add_option("--json", options->json, "Figures to write (.json)");
  command->add_option("--plots", options->plots, "Folder to draw curves over time and range into")
      ->type_name("DIR");
  command->callback([options] { evaluate(*options); });
}

}  // namespace laneloom
