#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>

#include "commands/commands.hpp"
#include "commands/options.hpp"
#include "commands/road_source.hpp"
#include "io/json_lines.hpp"

namespace laneloom {
namespace {

struct Options {
  RoadSource source;
  double duration_s = 0.0;
  std::string frames, truth;
};

void simulate(const Options& options) {
  const Road road = options.source.load();
  if (!options.truth.empty()) save_truth(options.truth, road);
  Perception perception = options.source.perception(road);
  const double duration_s = options.duration_s > 0.0 ? options.duration_s : road.drive.duration_s();
  const auto frames = static_cast<std::int64_t>(std::floor(duration_s * 10.0));
  JsonLinesWriter out(options.frames);
  for (std::int64_t i = 1; i <= frames; ++i) {  // from 0.1 s: the stamp 0 means none
    VehiclePose pose = road.drive.pose_at(static_cast<double>(i) * 0.1);
    pose.stamp_ns = i * 100'000'000;
    out.write(FrameRecord{perception.observe(pose), pose});
  }
  out.close();
  fmt::print("{}: {} frames of {}\n", options.frames, frames, road.name);
}

}  // namespace

void add_simulate(CLI::App& app) {
  CLI::App* command = app.add_subcommand("simulate", "Writes detections of a drive over a road, without DDS");
  const auto options = std::make_shared<Options>();
  add_road_source(*command, options->source);
  command->add_option("--duration", options->duration_s, "Seconds; default: the drive once")
      ->check(positive_seconds());
  command->add_option("--frames", options->frames, "Detections and poses to write (.frames.jsonl)")
      ->required();
  command->add_option("--truth", options->truth, "Truth of the road to write (.json)");
  command->callback([options] { simulate(*options); });
}

}  // namespace laneloom
