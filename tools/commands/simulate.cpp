#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>

#include "commands/commands.hpp"
#include "commands/given_files.hpp"
#include "commands/log_files.hpp"
#include "commands/options.hpp"
#include "commands/road_source.hpp"
#include "io/json_lines.hpp"
#include "support/progress_bar.hpp"

namespace laneloom::commands {
namespace {

struct SimulateOptions {
  RoadSource source;
  double duration_s = 0.0;
  std::string frames, truth;
};

void simulate(const RoadSource& source, double duration_s, const std::string& frames_file,
              const std::string& truth_file) {
  refuse_overwriting({source.lanelet2, source.opendrive}, {frames_file, truth_file});
  const simulation::Road road = source.load();
  if (!truth_file.empty()) save_truth(truth_file, road);
  simulation::Perception perception = source.perception(road);
  const Tracker tracker = source.tracker(road);
  if (!(duration_s > 0.0)) duration_s = road.drive.duration_s();
  const auto frames = static_cast<std::int64_t>(std::floor(duration_s * 10.0));
  io::JsonLinesWriter out(frames_file);
  support::ProgressBar bar;
  for (std::int64_t i = 1; i <= frames; ++i) {  // from 0.1 s on: a stamp of 0 would mean none
    const double drive_s = static_cast<double>(i) * 0.1;
    VehiclePose pose = road.drive.pose_at(drive_s);
    pose.stamp_ns = i * 100'000'000;
    io::FrameRecord record{perception.observe(pose), pose};
    if (tracker) record.objects = tracker(pose, drive_s);
    out.write(record);
    bar.step(static_cast<double>(i) / static_cast<double>(frames));
  }
  bar.clear();
  out.close();
  fmt::print("{}: {} frames of {}\n", frames_file, frames, road.name);
}

void simulate_each(const SimulateOptions& options) {
  for (const RoadSource& source : options.source.each()) {
    const auto file = [&](const std::string& path, const char* ending) {
      return file_of_log(path, options.source.argoverse2, source.argoverse2, ending);
    };
    simulate(source, options.duration_s, file(options.frames, ".frames.jsonl"),
             file(options.truth, ".truth.json"));
  }
}

}  // namespace

void add_simulate(CLI::App& app) {
  CLI::App* command = app.add_subcommand("simulate", "Writes detections of a drive over a road, without DDS");
  const auto options = std::make_shared<SimulateOptions>();
  add_road_source(*command, options->source);
  command->add_option("--duration", options->duration_s, "Seconds; default: the drive once")
      ->check(positive_seconds());
  add_text_output(*command, "--frames", options->frames,
                  "Detections and poses to write (.frames.jsonl); - is standard output")
      ->required();
  add_text_output(*command, "--truth", options->truth, "Truth of the road to write (.json)");
  command->footer("For a directory of logs, --frames and --truth are folders, with a file per log.");
  command->callback([options] { simulate_each(*options); });
}

}  // namespace laneloom::commands
