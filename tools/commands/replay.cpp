#include <fmt/format.h>
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "commands/commands.hpp"
#include "commands/options.hpp"
#include "commands/stage_timer.hpp"
#include "io/json_lines.hpp"
#include "laneloom/config_file.hpp"
#include "laneloom/mapper.hpp"

namespace laneloom {
namespace {

struct Options {
  std::string in, out, report, config_file, preset;
  RangeConfig range;
  bool range_given = false;
};

Config read_config(const Options& options) {
  Config config = options.config_file.empty() ? Config{} : load_config(options.config_file);
  if (!options.preset.empty()) apply_preset(config, options.preset);
  if (options.range_given) {
    config.mapper.range.forward_min_m = options.range.forward_min_m;
    config.mapper.range.forward_max_m = options.range.forward_max_m;
    config.mapper.range.side_max_m = options.range.side_max_m;
  }
  validate(config);
  return config;
}

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

void print_row(const char* name, const TimeSummary& time) {
  fmt::print("{:<16} {:>9.3f} {:>9.3f} {:>9.3f} {:>9.3f}\n", name, time.mean_ms, time.p50_ms, time.p99_ms,
             time.max_ms);
}

void print_times(const StageTimer& timer) {
  fmt::print("{:<16} {:>9} {:>9} {:>9} {:>9}\n", "milliseconds", "mean", "p50", "p99", "max");
  for (std::size_t i = 0; i < kStageCount; ++i)
    print_row(name(static_cast<Stage>(i)), timer.stage(static_cast<Stage>(i)));
  print_row("total", timer.total());
}

nlohmann::json to_json(const TimeSummary& time) {
  return {{"mean", time.mean_ms}, {"p50", time.p50_ms}, {"p99", time.p99_ms}, {"max", time.max_ms}};
}

void write_report(const std::string& path, std::size_t frames, const StageTimer& timer) {
  nlohmann::json report{{"frames", frames}, {"peak_rss_mb", peak_memory_mb()}};
  report["ms"]["total"] = to_json(timer.total());
  for (std::size_t i = 0; i < kStageCount; ++i)
    report["ms"][name(static_cast<Stage>(i))] = to_json(timer.stage(static_cast<Stage>(i)));
  std::ofstream out(path);
  out << report.dump(2) << '\n';
  out.close();
  if (!out) throw std::runtime_error(path + ": cannot be written");
}

void replay(const Options& options) {
  Mapper mapper(read_config(options).mapper);
  JsonLinesReader in(options.in);
  std::unique_ptr<JsonLinesWriter> out;
  if (!options.out.empty()) out = std::make_unique<JsonLinesWriter>(options.out);
  StageTimer timer;
  std::size_t frames = 0;
  std::int64_t last_stamp_ns = 0;
  while (const std::optional<FrameRecord> record = in.next_frame()) {
    if (frames > 0 && record->frame.stamp_ns <= last_stamp_ns)
      throw std::runtime_error(
          fmt::format("{}: frame {} is not later than the one before it", options.in, frames + 1));
    last_stamp_ns = record->frame.stamp_ns;
    timer.start_frame();
    const LocalMap& map = mapper.update(record->frame, transform(record->pose), &timer);
    timer.end_frame();
    if (out) out->write(map);
    ++frames;
  }
  if (out) out->close();
  print_times(timer);
  fmt::print("{} frames\n", frames);
  if (!options.report.empty()) write_report(options.report, frames, timer);
}

}  // namespace

void add_replay(CLI::App& app) {
  CLI::App* command = app.add_subcommand("replay", "Fuses recorded detections into maps, without DDS");
  const auto options = std::make_shared<Options>();
  command->add_option("--in", options->in, "Detections and poses (.frames.jsonl)")->required();
  command->add_option("--out", options->out, "Maps to write, one a frame (.jsonl)");
  command->add_option("--report", options->report, "Timing report to write (.json)");
  command->add_option("--config", options->config_file, "Configuration (.yaml)");
  command->add_option("--preset", options->preset, "Range and alpha_n of a data set of the paper")
      ->check(CLI::IsMember({"inhouse", "av2"}));
  const CLI::Option* range = add_range(*command, options->range);
  command->callback([options, range] {
    options->range_given = range->count() > 0;
    replay(*options);
  });
}

}  // namespace laneloom
