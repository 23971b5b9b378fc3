#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <thread>
#include <utility>

#include "commands/check_drive.hpp"
#include "commands/commands.hpp"
#include "commands/evaluation_tables.hpp"
#include "commands/exit_codes.hpp"
#include "commands/explain.hpp"
#include "commands/given_files.hpp"
#include "commands/options.hpp"
#include "commands/recorded_configuration.hpp"
#include "commands/replay_report.hpp"
#include "commands/stop_signal.hpp"
#include "commands/warn_of.hpp"
#include "config/config_file.hpp"
#include "evaluation/map_evaluation.hpp"
#include "io/new_file.hpp"
#include "replay/message_source.hpp"
#include "replay/player.hpp"
#include "replay/replay.hpp"
#include "support/progress_bar.hpp"
#include "support/worker.hpp"

namespace laneloom::commands {
namespace {

using SteadyClock = std::chrono::steady_clock;

struct ReplayOptions {
  std::string in, report, preset, truth, explain;
  std::vector<std::string> config_files, out;
  std::string compression = "zstd";
  RangeConfig range;
  bool range_given = false;
  bool verify = false;
  bool publish = false;
  bool strict = false;
  int readers = 0;
  DdsConfig dds;
  double speed_up = 1.0;
};

/// The configuration with the range that is given, if one is.
Config adjusted(Config config, const ReplayOptions& options) {
  if (options.range_given) {
    config.mapper.range.forward_min_m = options.range.forward_min_m;
    config.mapper.range.forward_max_m = options.range.forward_max_m;
    config.mapper.range.side_max_m = options.range.side_max_m;
  }
  config::validate(config);
  return config;
}

Config read_config(const ReplayOptions& options, const std::string& file) {
  return adjusted(config::resolve_config(file, options.preset), options);
}

/// The configuration that explains a drive: where none is given, that which made its maps.
Config explaining_config(const ReplayOptions& options) {
  if (!options.config_files.empty()) return read_config(options, options.config_files.front());
  return options.preset.empty() ? adjusted(recorded_config(options.in), options) : read_config(options, "");
}

/// Replays the whole input with one configuration.
ReplayResult run(const ReplayOptions& options, const std::string& config_file, const std::string& out,
                 const simulation::Road* truth) {
  const Config config = read_config(options, config_file);
  const std::unique_ptr<replay::MessageSource> source =
      replay::open_messages(options.in, config.dds.map_frame_id, {.strict = options.strict});
  const std::unique_ptr<replay::MapOutput> output =
      out.empty() ? nullptr
                  : replay::create_map_output(out, {.compression = kCompressions.at(options.compression),
                                                    .configuration = config::dump(config)});
  std::unique_ptr<evaluation::MapEvaluation> evaluation;
  if (truth != nullptr)
    evaluation =
        std::make_unique<evaluation::MapEvaluation>(*truth, config.mapper.range, evaluation::Subject::maps);
  ReplayResult result;
  result.name = config_file.empty() ? "default" : config_file;
  replay::MapHash hash;
  support::Worker worker;  // writes and rates a map while the next one is made
  const auto take_map = [&](PublishedMap taken, std::int64_t log_time_ns) {
    worker.add([&, map = std::move(taken), log_time_ns]() mutable {
      result.add(map.map);
      if (output) output->write(map, log_time_ns);
      if (options.verify) result.comparison.add_replayed(map);
      if (evaluation) evaluation->add(map.map);
      hash.add(std::move(map));
    });
  };
  replay::Replay replay(config, take_map, &result.timer);
  support::ProgressBar bar;
  const auto start = SteadyClock::now();
  ReplayInput input;
  const auto next = [&] { return options.verify ? source->next() : source->next_input(); };
  while (std::optional<recording::RecordedMessage> message = next()) {
    bar.step(source->progress());
    if (options.verify) worker.add([&, live = message->message] { result.add_live(live); });
    input.add(message->message);
    replay.add(std::move(*message));
  }
  worker.finish();
  if (output) output->close();
  bar.clear();
  result.elapsed_s = std::chrono::duration<double>(SteadyClock::now() - start).count();
  result.hash = hash.text();
  result.counters = replay.counters();
  result.pending = replay.pending();
  result.advice = advice_on(input, result, config.mapper);
  if (evaluation) result.score = evaluation->score();
  warn_of(options.in, source->refused(), source->left_out());
  return result;
}

void check_live(const std::string& drive, const ReplayResult& result) {
  const replay::LiveComparison::Result live = result.comparison.result();
  fmt::print("live messages: {} equal, {} different, {} missing\n", live.equal, live.different, live.missing);
  if (live.equal + live.different + live.missing == 0)
    throw std::runtime_error("the recording has no maps of a live service to compare with");
  if (live.holds()) return;
  if (live.began_late)
    fmt::print(stderr,
               "laneloom: {}: the recording began while the service had a map: what it had seen before is "
               "missing in the replay. Record before the first frame is sent, or restart the service.\n",
               drive);
  end_with(kFoundWrong);
}

/// Refuses to write a file that is read, or one that is written already.
void check_files(const ReplayOptions& options) {
  std::vector<std::string> read = options.config_files, written = options.out;
  read.insert(read.end(), {options.in, options.truth});
  written.push_back(options.report);
  refuse_overwriting(read, written);
}

void replay(ReplayOptions& options) {
  if (!options.explain.empty() && options.config_files.size() > 1)
    throw CLI::ValidationError("--explain", "takes one --config");
  if (!options.explain.empty()) return explain(options.in, explaining_config(options), options.explain);
  check_files(options);
  refuse_second_reading({options.in}, options.config_files.size() > 1 ? "a second --config" : "");
  if (!options.out.empty() && options.out.size() != std::max<std::size_t>(1, options.config_files.size()))
    throw std::runtime_error("replay: --out is needed once per --config, or not at all");
  if (options.config_files.empty()) options.config_files.emplace_back();
  std::unique_ptr<const simulation::Road> truth;
  if (!options.truth.empty())
    truth = std::make_unique<const simulation::Road>(simulation::load_truth(options.truth));
  std::vector<ReplayResult> results;
  results.reserve(options.config_files.size());
  for (std::size_t i = 0; i < options.config_files.size(); ++i) {
    const std::string out = options.out.empty() ? std::string() : options.out[i];
    io::make_file(out, [&] { results.push_back(run(options, options.config_files[i], out, truth.get())); });
  }
  for (const ReplayResult& result : results) {
    print_result(result);
    if (!result.advice.empty()) fmt::print(stderr, "laneloom: {}: {}\n", options.in, result.advice);
  }
  // A road has lanes: without, the input is likely at fault.
  if (std::ranges::any_of(results, [](const ReplayResult& result) { return result.lanes < result.maps; }) ||
      results.front().maps == 0)
    fmt::print(stderr, "{}", why_poor(options.in, read_config(options, options.config_files.front())));
  if (results.size() > 1) print_comparison(results);
  if (truth) {
    std::vector<NamedScore> scores;
    scores.reserve(results.size());
    for (const ReplayResult& result : results) scores.emplace_back(result.name, result.score);
    fmt::print("{}", score_table(scores));
  }
  if (!options.report.empty()) write_report(options.report, results);
  if (options.verify) {
    for (const ReplayResult& result : results) check_live(options.in, result);
  }
  const auto is_vain = [](const ReplayResult& result) { return result.maps == 0; };
  if (!std::ranges::all_of(results, is_vain)) return;
  std::ranges::for_each(options.out, io::discard);
  end_with(kFailed);
}

/// The topics that the input may have. Standard input can only be read once.
replay::OptionalTopics topics_of(const ReplayOptions& options) {
  if (options.in == io::kStandard) return {.objects = true, .next_turns = true};
  return replay::optional_topics(*replay::open_messages(options.in, options.dds.map_frame_id));
}

void play(const ReplayOptions& options) {
  catch_stop_signals();
  const std::unique_ptr<replay::MessageSource> source =
      replay::open_messages(options.in, options.dds.map_frame_id, {.strict = options.strict});
  replay::Player player(options.dds, options.speed_up, topics_of(options));
  while (player.readers() < options.readers)
    if (!sleep_until(SteadyClock::now() + std::chrono::milliseconds(20))) return;
  if (options.readers > 0 && !sleep_until(SteadyClock::now() + kDiscovery)) return;
  support::ProgressBar bar;
  while (const std::optional<recording::RawMessage> message = source->next_raw()) {
    if (!sleep_until(player.due(*message))) break;
    player.publish(*message);
    bar.step(source->progress());
  }
  std::this_thread::sleep_for(kDelivery);
  bar.clear();
  warn_of(options.in, source->refused(), source->left_out());
  fmt::print("{} detections and {} poses published", player.detections(), player.poses());
  if (player.not_taken() > 0) fmt::print(", {} messages not taken by DDS", player.not_taken());
  fmt::print("\n");
}

}  // namespace

void add_replay(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("replay", "Fuses recorded detections into maps, or publishes them again");
  const auto options = std::make_shared<ReplayOptions>();
  command->add_option("--in,drive", options->in, "Recording (MCAP), or detections and poses (.frames.jsonl)")
      ->required();
  auto* out = add_text_output(*command, "--out", options->out,
                              "Maps to write, one a frame: .mcap, else JSON lines; - is standard output");
  add_compression(*command, options->compression)->needs(out);
  auto* report = add_text_output(*command, "--report", options->report, "Timing report to write (.json)");
  auto* config =
      command->add_option("--config", options->config_files, "Configuration (.yaml); several are compared");
  auto* preset =
      command->add_option("--preset", options->preset, "Range and alpha_n of a data set of the paper")
          ->check(CLI::IsMember(config::preset_names()));
  auto* truth =
      command->add_option("--truth", options->truth, "Truth of the road (.json), to rate the maps by");
  auto* verify = command->add_flag("--verify", options->verify,
                                   "Fail unless the maps equal those that a live service published");
  auto* explain = command->add_option(
      "--explain", options->explain,
      "Tell why: ID@TIME of a line or lane, as 23@12.5, or dN@TIME of detection N; in s since the first map");
  auto* strict = add_strict(*command, options->strict);
  for (CLI::Option* of_whole_drives : {out, report, truth, verify, strict})
    explain->excludes(of_whole_drives);
  CLI::Option* range = add_range(*command, options->range);
  CLI::Option* publish = command->add_flag("--publish", options->publish,
                                           "Publish the detections and poses on DDS, as they came");
  for (CLI::Option* of_maps : {out, report, config, preset, truth, verify, explain, range})
    publish->excludes(of_maps);
  command->add_option("--speed-up", options->speed_up, "With --publish: recorded seconds per second")
      ->check(within(0.01, 100.0))
      ->needs(publish)
      ->capture_default_str();
  command->add_option("--wait-for-readers", options->readers, "With --publish: number of readers to wait for")
      ->check(CLI::NonNegativeNumber)
      ->needs(publish);
  for (CLI::Option* option : add_dds(*command, options->dds)) option->needs(publish);
  command->callback([options, range] {
    options->range_given = range->count() > 0;
    options->publish ? play(*options) : replay(*options);
  });
}

}  // namespace laneloom::commands
