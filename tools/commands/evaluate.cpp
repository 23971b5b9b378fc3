#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include "commands/check_drive.hpp"
#include "commands/commands.hpp"
#include "commands/evaluate_later.hpp"
#include "commands/evaluation_tables.hpp"
#include "commands/given_files.hpp"
#include "commands/options.hpp"
#include "commands/read_input.hpp"
#include "config/config_file.hpp"
#include "evaluation/inputs.hpp"
#include "evaluation/map_evaluation.hpp"
#include "io/json_text.hpp"
#include "io/text_file.hpp"
#include "replay/replay.hpp"
#include "support/progress_bar.hpp"
#include "support/worker.hpp"

namespace laneloom::commands {
namespace {

struct EvaluateOptions : LaterInputs {
  bool later = false;
  std::string truth, json, plots;
  RangeConfig range;
};

using Stamps = std::set<std::int64_t>;

/// The stamps of a file that are compared, and the number of all its frames or maps.
struct Moments {
  Stamps stamps;
  std::size_t count = 0;
};

Moments moments(const std::string& path, Stamps stamps, std::size_t count) {
  if (stamps.empty())
    throw std::runtime_error(fmt::format("{}: of {} frames or maps, none can be compared", path, count));
  return {std::move(stamps), count};
}

Moments frame_moments(const std::string& path, bool strict) {
  Stamps stamps;
  const auto add = [&](const DetectionFrame& frame, const Eigen::Isometry3d& /*T_map_body*/) {
    stamps.insert(frame.stamp_ns);
  };
  const std::size_t count = for_each_frame(path, strict, add);
  return moments(path, std::move(stamps), count);
}

Moments map_moments(const std::string& path, bool strict) {
  Stamps stamps;
  const std::size_t count =
      for_each_map(path, strict, [&](const LocalMap& map) { stamps.insert(map.stamp_ns); });
  return moments(path, std::move(stamps), count);
}

/// The comparison of files, at the stamps that all of them have.
struct Comparison {
  Stamps stamps;
  std::string account;  ///< how much is compared, in words
};

Comparison comparison(const EvaluateOptions& options) {
  if (options.map.empty()) {
    Moments frames = frame_moments(options.frames, options.strict);
    return {frames.stamps, fmt::format("{} of {} frames", frames.stamps.size(), frames.count)};
  }
  if (options.frames.empty()) {
    Moments maps = map_moments(options.map, options.strict);
    return {maps.stamps, fmt::format("{} of {} maps", maps.stamps.size(), maps.count)};
  }
  const Moments frames = frame_moments(options.frames, options.strict),
                maps = map_moments(options.map, options.strict);
  Stamps common;
  std::set_intersection(frames.stamps.begin(), frames.stamps.end(), maps.stamps.begin(), maps.stamps.end(),
                        std::inserter(common, common.end()));
  if (common.empty()) throw std::runtime_error("detections and maps have no stamp in common");
  const std::string account =
      fmt::format("{0} of {1} frames, and {0} of {2} maps", common.size(), frames.count, maps.count);
  return {std::move(common), account};
}

evaluation::MapEvaluation evaluate_detections(const EvaluateOptions& options, const simulation::Road& truth,
                                              const std::string& frames, const Stamps& stamps) {
  evaluation::MapEvaluation evaluation(truth, options.range, evaluation::Subject::detections);
  support::ProgressBar bar;
  evaluation::for_each_frame(frames,
                             [&](const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body) {
                               if (stamps.contains(frame.stamp_ns))
                                 evaluation.add(frame, T_map_body, options.min_confidence);
                             },
                             {.on_step = [&](double share) { bar.step(share); }});
  return evaluation;
}

evaluation::MapEvaluation evaluate_maps(const EvaluateOptions& options, const simulation::Road& truth,
                                        const Stamps& stamps) {
  evaluation::MapEvaluation evaluation(truth, options.range, evaluation::Subject::maps);
  support::ProgressBar bar;
  evaluation::for_each_map(options.map,
                           [&](const LocalMap& map) {
                             if (stamps.contains(map.stamp_ns)) evaluation.add(map);
                           },
                           {.on_step = [&](double share) { bar.step(share); }});
  return evaluation;
}

/// A drive that was mapped.
struct Mapped {
  evaluation::MapEvaluation evaluation;
  Stamps stamps;  ///< of the maps
};

Mapped evaluate_mapped(const EvaluateOptions& options, const simulation::Road& truth) {
  Mapped mapped{{truth, options.range, evaluation::Subject::maps}, {}};
  std::optional<LocalMap> newest;  // another one of its stamp may follow
  support::Worker worker;          // rates a map while the next one is made
  const auto take_newest = [&] {
    if (!newest || !mapped.stamps.insert(newest->stamp_ns).second) return;
    worker.add([&, map = *std::exchange(newest, std::nullopt)] { mapped.evaluation.add(map); });
  };
  const Config config = config::resolve_config(options.config, {});
  replay::Replay replay(config, [&](PublishedMap map, std::int64_t /*log_time_ns*/) {
    if (map.map.stamp_ns <= 0) return;  // no frame was fused yet
    if (newest && newest->stamp_ns != map.map.stamp_ns) take_newest();
    newest = std::move(map.map);
  });
  replay_input(options.in, config, options.strict, replay);
  take_newest();
  worker.finish();
  mapped.stamps = moments(options.in, std::move(mapped.stamps), 0).stamps;
  return mapped;
}

LaterRating later_rating(const EvaluateOptions& options) {
  LaterRating rating = evaluate_later(options);
  const std::string& drive = options.in.empty() ? options.frames : options.in;
  fmt::print(stderr, "{}", why_poor(drive, config::resolve_config(options.config, {})));
  require_rated(rating.later, drive);
  return rating;
}

void rate_by_later(const EvaluateOptions& options) {
  const auto [later, steadiness] = later_rating(options);
  const evaluation::Steadiness steady = steadiness.steadiness();
  fmt::print("{}{}", later_table(later), steadiness_table(steady));
  if (options.json.empty()) return;
  nlohmann::json json = later_json(later);
  json["planner"] = steadiness_json(steady);
  io::write_text(options.json, io::json_text(json, 2) + "\n");
}

/// Prints and writes the rating of detections and maps by the truth. `account` tells how much was compared.
void tell(const EvaluateOptions& options, const std::vector<NamedEvaluation>& evaluations,
          const std::string& account) {
  std::vector<NamedScore> scores;
  scores.reserve(evaluations.size());
  for (const auto& [who, evaluation] : evaluations) scores.emplace_back(who, evaluation.score());
  fmt::print("{}{} compared, range {:g}..{:g} m, +-{:g} m\n", score_table(scores), account,
             options.range.forward_min_m, options.range.forward_max_m, options.range.side_max_m);
  fmt::print("{}{}", evaluation_tables(evaluations), profile_table(evaluations));
  if (!options.plots.empty()) draw_evaluation(evaluations, options.plots);
  if (options.json.empty()) return;
  nlohmann::json json = score_json(scores);
  json.update(evaluation_json(evaluations), true);
  json.update(profile_json(evaluations), true);
  io::write_text(options.json, io::json_text(json, 2) + "\n");
}

void rate_by_truth(const EvaluateOptions& options) {
  const simulation::Road truth = simulation::load_truth(options.truth);
  std::vector<NamedEvaluation> evaluations;
  if (!options.in.empty()) {
    Mapped mapped = evaluate_mapped(options, truth);
    evaluations.emplace_back("raw", evaluate_detections(options, truth, options.in, mapped.stamps));
    evaluations.emplace_back("fused", std::move(mapped.evaluation));
    return tell(options, evaluations, fmt::format("{} frames and their maps", mapped.stamps.size()));
  }
  const auto [stamps, account] = comparison(options);
  if (!options.frames.empty())
    evaluations.emplace_back("raw", evaluate_detections(options, truth, options.frames, stamps));
  if (!options.map.empty()) evaluations.emplace_back("fused", evaluate_maps(options, truth, stamps));
  tell(options, evaluations, account);
}

void evaluate(const EvaluateOptions& options) {
  refuse_overwriting({options.in, options.frames, options.map, options.truth, options.config},
                     {options.json});
  refuse_second_reading({options.in, options.frames, options.map}, options.truth.empty() ? "" : "--truth");
  if (!options.later) return rate_by_truth(options);
  if (options.in.empty() && (options.frames.empty() || options.map.empty()))
    throw CLI::RequiredError("--later: --in, or --frames and --map");
  rate_by_later(options);
}

}  // namespace

void add_evaluate(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "evaluate",
      "Rates detections and maps. Your own drive needs no truth, but is rated by what is seen later from "
      "close "
      "by: laneloom evaluate --later --in drive.mcap. By truth: precision, recall, stability, lanes, trust");
  const auto options = std::make_shared<EvaluateOptions>();
  CLI::Option_group* references = command->add_option_group("Rated by", "one of");
  references->add_flag("--later", options->later,
                       "What the vehicle sees later from close by; needs --in, or --frames and --map");
  CLI::Option* truth = references->add_option("--truth", options->truth, "Truth of the road (.json)");
  references->require_option(1);
  CLI::Option_group* inputs = command->add_option_group("Inputs", "compared at their common stamps");
  CLI::Option* in =
      inputs->add_option("--in,drive", options->in, "Drive (.mcap or .frames.jsonl), to be mapped");
  inputs->add_option("--frames", options->frames, "Single detections (.frames.jsonl or .mcap)")->excludes(in);
  inputs->add_option("--map", options->map, "Fused maps (.jsonl or .mcap)")->excludes(in);
  inputs->require_option(1, 2);
  command->add_option("--config", options->config, "Configuration to map with (.yaml)")->needs(in);
  add_range(*command, options->range)->needs(truth);
  command
      ->add_option("--min-confidence", options->min_confidence,
                   "Least confidence of the single detections that count")
      ->check(within(0.0, 1.0))
      ->capture_default_str();
  add_text_output(*command, "--json", options->json, "Figures to write (.json); - is standard output");
  command->add_option("--plots", options->plots, "Folder to draw curves over time and range into")
      ->type_name("DIR")
      ->needs(truth);
  add_strict(*command, options->strict);
  command->callback([options] { evaluate(*options); });
}

}  // namespace laneloom::commands
