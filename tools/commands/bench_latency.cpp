#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "bench/latency.hpp"
#include "commands/bench.hpp"
#include "commands/bench_drive.hpp"
#include "commands/time_table.hpp"

namespace laneloom::commands {
namespace {

struct BenchLatencyOptions {
  BenchDrive drive;
  DdsConfig dds;
  std::filesystem::path identities;
  double delay_spread_ms = 100.0;
  std::size_t viewers = 0;
  bool load = false;
  bool json = false;
};

bench::LatencySpec latency_spec(const BenchLatencyOptions& options) {
  const auto folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  bench::LatencySpec spec{.service = folder / "laneloomd",
                          .publisher = folder / "laneloom",
                          .dds = options.dds,
                          .identities = options.identities,
                          .scenario = options.drive.scenario,
                          .noise = options.drive.noise,
                          .speed_mps = options.drive.speed_mps,
                          .delay_spread_ms = options.delay_spread_ms,
                          .duration_s = options.drive.duration_s,
                          .busy_threads = options.load ? std::thread::hardware_concurrency() : 0,
                          .viewers = options.viewers};
  spec.dds.vehicle_id = fmt::format("bench_{}", getpid());  // apart from every other vehicle
  return spec;
}

nlohmann::json viewer_json(const bench::ViewerCost& viewer) {
  return {{"cpu_percent", viewer.cpu_percent},
          {"peak_rss_mb", viewer.peak_rss_mb},
          {"frames_per_s", viewer.frames_per_s}};
}

nlohmann::json latency_json(const bench::LatencySpec& spec, const bench::LatencyResult& result) {
  return {
      {"duration_s", spec.duration_s},
      {"delay_spread_ms", spec.delay_spread_ms},
      {"transport", spec.dds.transport},
      {"secured", !spec.identities.empty()},
      {"busy_threads", spec.busy_threads},
      {"ticks", result.ticks},
      {"missed_deadlines", result.missed_deadlines},
      {"maps_lost", result.maps_lost},
      {"frames", result.frames},
      {"ms",
       {{"tick_delay", to_json(result.tick_delay)},
        {"tick_to_callback", to_json(result.tick_to_callback)},
        {"publication_to_callback", to_json(result.publication_to_callback)},
        {"detections_to_callback", to_json(result.detections_to_callback)}}},
      {"service", {{"cpu_percent", result.service_cpu_percent}, {"peak_rss_mb", result.service_peak_rss_mb}}},
      {"viewer", result.viewer ? viewer_json(*result.viewer) : nlohmann::json()}};
}

void print(const bench::LatencySpec& spec, const bench::LatencyResult& result) {
  print_time_header("milliseconds");
  print_time_row("tick: delay", result.tick_delay);
  print_time_row("tick to callback", result.tick_to_callback);
  print_time_row("publication to callback", result.publication_to_callback);
  print_time_row("detections to callback", result.detections_to_callback);
  fmt::print("{} ticks by {} with {} busy threads: {} deadlines missed, {} maps lost, {} frames\n",
             result.ticks, spec.dds.transport, spec.busy_threads, result.missed_deadlines, result.maps_lost,
             result.frames);
  fmt::print("the service: {:.1f} % of a core, peak memory {:.0f} MB\n", result.service_cpu_percent,
             result.service_peak_rss_mb);
  if (result.viewer)
    fmt::print(
        "laneloom view with {} viewers: {:.1f} % of a core, peak memory {:.0f} MB, {:.2f} frames/s each\n",
        spec.viewers, result.viewer->cpu_percent, result.viewer->peak_rss_mb, result.viewer->frames_per_s);
}

void latency(const BenchLatencyOptions& options) {
  const bench::LatencySpec spec = latency_spec(options);
  const bench::LatencyResult result = measure_latency(spec);
  options.json ? fmt::print("{}\n", latency_json(spec, result).dump()) : print(spec, result);
}

}  // namespace

void add_bench_latency(CLI::App& bench) {
  CLI::App* command = bench.add_subcommand(
      "latency", "Times ticks and maps of a real service, from a real publisher to this process, over DDS");
  const auto options = std::make_shared<BenchLatencyOptions>();
  options->drive.duration_s = 30.0;
  add_bench_road(*command, options->drive);
  command->add_option("--domain", options->dds.domain, "DDS domain")
      ->check(CLI::Range(0, 232))
      ->capture_default_str();
  command->add_option("--transport", options->dds.transport, "Transport of the service and this process")
      ->check(CLI::IsMember({"udp", "udp+shm"}))
      ->capture_default_str();
  command->add_option("--identities", options->identities,
                      "Use DDS-Security: folder of tools/make-certificates");
  command->add_option("--delay-spread", options->delay_spread_ms, "As of `laneloom publish`")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  command->add_option("--viewers", options->viewers, "Clients that read from a `laneloom view` beside it")
      ->check(CLI::Range(0, 64))
      ->capture_default_str();
  command->add_flag("--load", options->load, "Keep all cores busy meanwhile");
  command->add_flag("--json", options->json, "One JSON object");
  command->callback([options] { latency(*options); });
}

}  // namespace laneloom::commands
