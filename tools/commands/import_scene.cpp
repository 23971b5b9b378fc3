#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "commands/commands.hpp"
#include "commands/given_files.hpp"
#include "commands/options.hpp"
#include "commands/warn_of.hpp"
#include "io/new_file.hpp"
#include "scene/scene_recording.hpp"
#include "support/progress_bar.hpp"

namespace laneloom::commands {
namespace {

struct ImportSceneOptions {
  std::string in, out;
  std::string map_frame_id = "map";
};

void import_scene(const ImportSceneOptions& options) {
  refuse_overwriting({options.in}, {options.out});
  support::ProgressBar bar;
  scene::SceneRecordingReport report;
  io::make_file(options.out, [&] {
    report = scene::add_scene(options.in, options.out, options.map_frame_id,
                              [&](double share) { bar.step(share); });
  });
  bar.clear();
  warn_of(options.in, report.refused, report.left_out);
  fmt::print("{}: {} messages, {} of scenes\n", options.out, report.messages + report.scenes, report.scenes);
}

}  // namespace

void add_import_scene(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("scene", "Adds scenes for the 3D panels of Foxglove and Lichtblick to a recording");
  const auto options = std::make_shared<ImportSceneOptions>();
  command->add_option("--in,drive", options->in, "Recording (.mcap)")->required()->check(CLI::ExistingFile);
  add_recording_output(*command, options->out)->required();
  command->add_option("--map-frame-id", options->map_frame_id, "Frame of the poses; default: map");
  command->callback([options] { import_scene(*options); });
}

}  // namespace laneloom::commands
