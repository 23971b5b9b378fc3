#include "experiment/calibration.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "commands/lab_commands.hpp"
#include "commands/road_list.hpp"
#include "config/config_file.hpp"

namespace laneloom::commands {
namespace {

struct CalibrateOptions {
  RoadList roads;
  std::string noise = "inhouse";
  int steps = 15;
};

void print_step(const experiment::CalibrationStep& step) {
  for (const MarkingType type : kMarkingTypes) {
    const evaluation::Score& score = step.score.of(evaluation::line_kind(type));
    if (score.truths == 0) continue;
    fmt::print("{} {:.1f}/{:.1f}/{:.3f}  ", name(evaluation::line_kind(type)), 100 * score.precision(),
               100 * score.recall(), score.acd_m());
  }
  fmt::print("jitter {:.1f} cm\n", 100 * step.jitter_m);
  std::fflush(stdout);
}

template <std::size_t count>
std::string list(const std::array<double, count>& values) {
  std::string text;
  for (const double value : values) text += fmt::format("{}{:.3f}", text.empty() ? "" : ", ", value);
  return text;
}

void print_result(const experiment::CalibrationStep& step, const experiment::CalibrationTarget& target) {
  fmt::print("\n| {} | P % | R % | ACD m | target P/R/ACD |\n|---|---|---|---|---|\n", step.noise.name);
  for (const MarkingType type : kMarkingTypes) {
    const evaluation::Score& score = step.score.of(evaluation::line_kind(type));
    const experiment::CalibrationTarget::Kind& should = target.kinds.at(index(type));
    if (score.truths == 0 || should.precision <= 0.0) continue;
    fmt::print("| {} | {:.1f} | {:.1f} | {:.3f} | {:.1f}/{:.1f}/{:.3f} |\n",
               name(evaluation::line_kind(type)), 100 * score.precision(), 100 * score.recall(),
               score.acd_m(), 100 * should.precision, 100 * should.recall, should.acd_m);
  }
  fmt::print("\nmissed_share {{{}}}\nghost_rate_hz {{{}}}\nerror_factor {{{}}}\nflutter_stddev_m {:.4f}\n",
             list(step.noise.missed_share), list(step.noise.ghost_rate_hz), list(step.noise.error_factor),
             step.noise.flutter_stddev_m);
}

void run_calibration(const CalibrateOptions& options) {
  const experiment::CalibrationTarget target = experiment::calibration_target(options.noise);
  const simulation::NoiseProfile start = simulation::noise_profile(options.noise);
  Config ranged;
  config::apply_preset(ranged, options.noise);
  const experiment::CalibrationStep last =
      calibrate(start, target, options.roads.drives({start}), ranged.mapper.range, options.steps, print_step);
  print_result(last, target);
}

}  // namespace

void add_calibrate(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "calibrate", "Fits a noise profile until single detections score as the paper's network does");
  const auto options = std::make_shared<CalibrateOptions>();
  add_road_list(*command, options->roads);
  command->add_option("--noise", options->noise, "The profile, and the data set of the paper")
      ->check(CLI::IsMember({"inhouse", "av2"}))
      ->capture_default_str();
  command->add_option("--steps", options->steps, "1 only measures the profile as it is")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->callback([options] { run_calibration(*options); });
}

}  // namespace laneloom::commands
