#include "commands/bench.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <vector>

#include "bench/mapper_cost.hpp"
#include "bench/process_usage.hpp"
#include "commands/bench_drive.hpp"
#include "commands/lab_commands.hpp"
#include "commands/time_table.hpp"
#include "experiment/peer.hpp"

namespace laneloom::commands {
namespace {

struct BenchOptions {
  BenchDrive drive;
  std::string peer;
  bool json = false;
};

struct Result {
  std::size_t frames = 0;
  bench::MapperCost cost;
  double peak_rss_mb = 0.0;  ///< of this process, with the frames
  std::optional<experiment::PeerReport> peer;
};

Result measure(const BenchOptions& options) {
  const std::vector<experiment::SimulatedFrame> frames = simulate(options.drive.spec());
  if (frames.empty()) throw std::runtime_error("the drive has no frame");
  Result result{.frames = frames.size(), .cost = bench::measure(options.drive.mapper_config(), frames)};
  result.peak_rss_mb = bench::peak_rss_mb(getpid());
  if (!options.peer.empty()) result.peer = time_peer({options.peer, options.drive.preset}, frames);
  return result;
}

nlohmann::json peer_json(const experiment::PeerReport& peer, const TimeSummary& ours) {
  nlohmann::json ms{{"total", to_json(peer.total)}};
  for (const auto& [stage, time] : peer.stages) ms[stage] = to_json(time);
  return {{"ms", ms},
          {"peak_rss_mb", peer.peak_rss_mb},
          {"ratio", {{"mean", peer.total.mean_ms / ours.mean_ms}, {"p99", peer.total.p99_ms / ours.p99_ms}}}};
}

nlohmann::json result_json(const Result& result) {
  const TimeSummary update = result.cost.update();
  nlohmann::json json{{"frames", result.frames},
                      {"ms", to_json(result.cost.stages)},
                      {"allocations_per_frame", result.cost.allocations_per_update()},
                      {"heap_mb", static_cast<double>(result.cost.heap_bytes) / bench::kBytesPerMB},
                      {"peak_heap_mb", static_cast<double>(result.cost.peak_heap_bytes) / bench::kBytesPerMB},
                      {"peak_rss_mb", result.peak_rss_mb},
                      {"peer", nullptr}};
  json["ms"]["total"] = to_json(update);
  if (result.peer) json["peer"] = peer_json(*result.peer, update);
  return json;
}

void print(const Result& result) {
  const TimeSummary update = result.cost.update();
  print_time_header("milliseconds");
  print_stage_rows(result.cost.stages);
  print_time_row("total", update);
  fmt::print(
      "{} frames; {:.0f} allocations per frame; heap of the mapper {:.2f} MB, at most {:.2f} MB; peak memory "
      "of this process, with all frames, {:.0f} MB\n",
      result.frames, result.cost.allocations_per_update(),
      static_cast<double>(result.cost.heap_bytes) / bench::kBytesPerMB,
      static_cast<double>(result.cost.peak_heap_bytes) / bench::kBytesPerMB, result.peak_rss_mb);
  if (!result.peer) return;
  fmt::print("\n");
  print_time_header("the peer");
  for (const auto& [stage, time] : result.peer->stages) print_time_row(stage, time);
  print_time_row("total", result.peer->total);
  fmt::print("peak memory {:.0f} MB\npeer / laneloom: mean {:.1f}, p99 {:.1f}\n", result.peer->peak_rss_mb,
             result.peer->total.mean_ms / update.mean_ms, result.peer->total.p99_ms / update.p99_ms);
}

void bench(const BenchOptions& options) {
  const Result result = measure(options);
  options.json ? fmt::print("{}\n", result_json(result).dump()) : print(result);
}

}  // namespace

void add_bench(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("bench", "Times the mapper's stages, also against a peer on the same frames");
  const auto options = std::make_shared<BenchOptions>();
  add_bench_drive(*command, options->drive);
  command->add_option("--peer", options->peer, "Another program that maps JSON lines to JSON lines");
  command->add_flag("--json", options->json, "One JSON object");
  const std::vector<CLI::Option*> own = command->get_options();
  add_bench_latency(*command);
  add_bench_scale(*command);
  add_bench_worst(*command);
  // Each measurement has its own options behind its name. Options before its name would be ignored.
  for (CLI::App* measurement : command->get_subcommands({})) {
    for (CLI::Option* option : own) measurement->excludes(option);
  }
  command->callback([command, options] {
    if (command->get_subcommands().empty()) bench(*options);
  });
}

}  // namespace laneloom::commands
