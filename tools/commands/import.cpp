#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "commands/check_drive.hpp"
#include "commands/class_option.hpp"
#include "commands/commands.hpp"
#include "commands/given_files.hpp"
#include "commands/log_files.hpp"
#include "commands/options.hpp"
#include "commands/warn_of.hpp"
#include "import/drive_log.hpp"
#include "import/drive_recording.hpp"
#include "import/maptr.hpp"
#include "import/openpilot.hpp"
#include "import/streammapnet.hpp"
#include "io/new_file.hpp"
#include "io/printable.hpp"
#include "simulation/argoverse2.hpp"
#include "simulation/argoverse2_objects.hpp"
#include "simulation/road.hpp"
#include "support/progress_bar.hpp"

namespace laneloom::commands {
namespace {

struct ResultsOptions {
  std::string command;  ///< of laneloom import
  std::string results, out;
  std::string argoverse2, nuscenes, scene, poses, samples;
  std::string axes = "forward-left";
  imports::Classes classes = imports::usual_classes();
  bool strict = false;
};

imports::DriveLog load_drive(const ResultsOptions& options, LeftOut& left_out) {
  if (!options.argoverse2.empty()) return imports::argoverse2_drive(options.argoverse2, left_out);
  if (!options.nuscenes.empty()) return imports::nuscenes_drive(options.nuscenes, options.scene, left_out);
  return imports::plain_drive(options.poses, options.samples, io::axes_named(options.axes), left_out);
}

/// The files that the drive is read from, for messages.
std::string drive_source(const ResultsOptions& options) {
  if (!options.poses.empty()) return options.poses + " and " + options.samples;
  return options.argoverse2.empty() ? options.nuscenes : options.argoverse2;
}

/// Reads the part of a file of results that belongs to the drive.
using ReadResults = imports::ImportedFrames (*)(const std::filesystem::path& results,
                                                const imports::ResultsReading& reading);

/// The command that imports the results with a correction. It has --axes alone, and for own tables.
std::string command_with(const check::Correction& correction, const ResultsOptions& options) {
  if (!options.poses.empty() && check::options(correction) == check::options({.axes = correction.axes})) {
    const Eigen::Matrix3d axes = io::axes_named(correction.axes) * io::axes_named(options.axes);
    for (const std::string& name : io::axes_names())
      if (io::axes_named(name) == axes) return "laneloom import " + options.command + " --axes " + name;
  }
  return check::import_frames_command(correction);
}

void import_results(const ResultsOptions& options, ReadResults read) {
  refuse_overwriting({options.results, options.poses, options.samples}, {options.out});
  const imports::DriveLog drive =
      read_and_warn(drive_source(options), options.strict,
                    [&](LeftOut& left_out) { return load_drive(options, left_out); });
  imports::ImportedFrames imported = read_and_warn(options.results, options.strict, [&](LeftOut& left_out) {
    support::ProgressBar bar;
    return read(options.results, {drive, left_out, options.classes, [&](double share) { bar.step(share); }});
  });
  const std::size_t without_pose = imports::drop_frames_without_pose(imported.frames, drive.poses);
  if (imported.frames.empty())
    throw std::runtime_error(options.results + ": no sample is within the poses of " + drive.name);
  warn_of(options.out, imports::write_drive(options.out, drive.poses, imported.frames, {}, options.strict));
  fmt::print("{}: {} frames, {} poses\n", drive.name, imported.frames.size(), drive.poses.size());
  for (const auto& [class_name, lines] : imported.left_out)
    fmt::print("left out: {} lines of class {}\n", lines, class_name);
  if (without_pose > 0) fmt::print("left out: {} frames without poses around them\n", without_pose);
  if (imported.other_drives > 0)
    fmt::print("passed over: {} frames of other drives\n", imported.other_drives);
  fmt::print(stderr, "{}", doubts_of_import(options.out, [&](const check::Correction& correction) {
               return command_with(correction, options);
             }));
}

void add_drive(CLI::App& command, ResultsOptions& options) {
  CLI::Option_group* drive = command.add_option_group("Drive", "one of");
  drive->add_option("--argoverse2", options.argoverse2, "Directory of an Argoverse 2 log");
  CLI::Option* nuscenes =
      drive->add_option("--nuscenes", options.nuscenes, "Folder of nuScenes' tables (v1.0-…)");
  CLI::Option* poses = drive->add_option("--poses", options.poses,
                                         "Poses (.csv or .feather: timestamp_ns,qw,qx,qy,qz,tx_m,ty_m,tz_m)");
  drive->require_option(1);
  CLI::Option* scene = command.add_option("--scene", options.scene, "Scene of nuScenes, such as scene-0061");
  CLI::Option* samples =
      command.add_option("--samples", options.samples, "With --poses: samples (.csv: token,timestamp_ns)");
  nuscenes->needs(scene);
  scene->needs(nuscenes);
  poses->needs(samples);
  samples->needs(poses);
  add_axes(command, options.axes)->needs(poses);
}

void add_results(CLI::App& app, const std::string& name, const std::string& whose, const std::string& file,
                 ReadResults read) {
  CLI::App* command = app.add_subcommand(name, "Detections of " + whose + ", and the poses of a drive");
  const auto options = std::make_shared<ResultsOptions>();
  options->command = name;
  command->add_option("--results", options->results, "File that their evaluation wrote (" + file + ")")
      ->required();
  add_drive(*command, *options);
  add_classes(*command, options->classes);
  add_recording_output(*command, options->out)->required();
  add_strict(*command, options->strict);
  command->callback([options, read] { import_results(*options, read); });
}

struct OpenpilotOptions {
  std::string log, out;
  imports::Classes classes = imports::openpilot_classes();
  bool strict = false;
};

void import_openpilot(const OpenpilotOptions& options) {
  refuse_overwriting({options.log}, {options.out});
  imports::OpenpilotDrive drive = read_and_warn(options.log, options.strict, [&](LeftOut& left_out) {
    support::ProgressBar bar;
    return imports::read_openpilot(options.log,
                                   {left_out, options.classes, [&](double share) { bar.step(share); }});
  });
  const std::string qlog = imports::why_qlog(drive);
  if (!qlog.empty()) fmt::print(stderr, "laneloom: {}: {}\n", options.log, qlog);
  const std::size_t without_pose = imports::drop_frames_without_pose(drive.frames, drive.poses);
  if (drive.frames.empty()) throw std::runtime_error(options.log + ": no frame is within the poses");
  warn_of(options.out, imports::write_drive(options.out, drive.poses, drive.frames, {}, options.strict));
  fmt::print("{} frames, {} poses\n", drive.frames.size(), drive.poses.size());
  if (drive.invalid_frames > 0) fmt::print("left out: {} invalid frames\n", drive.invalid_frames);
  if (drive.invalid_poses > 0) fmt::print("left out: {} invalid poses\n", drive.invalid_poses);
  if (without_pose > 0) fmt::print("left out: {} frames without poses around them\n", without_pose);
  fmt::print(stderr, "{}", doubts_of_import(options.out));
}

void add_openpilot(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("openpilot", "Lane lines, road edges and odometry of an openpilot log");
  const auto options = std::make_shared<OpenpilotOptions>();
  command->add_option("--log", options->log, "The log as JSON, one event a line (.jsonl)")->required();
  add_classes(*command, options->classes)->check([](const std::string& word) {
    const bool is_list = imports::openpilot_classes().contains(word.substr(0, word.rfind('=')));
    return is_list ? ""
                   : word + ": the lists of lines are " + imports::names_of(imports::openpilot_classes());
  });
  add_recording_output(*command, options->out)->required();
  add_strict(*command, options->strict);
  command->footer(
      "The log as JSON: zstdcat rlog.zst | capnp convert --short binary:json openpilot/cereal/log.capnp "
      "Event");
  command->callback([options] { import_openpilot(*options); });
}

struct LogOptions {
  std::string directory, out, truth;
  bool strict = false;
};

/// What is imported of a log.
struct LogContent {
  std::optional<simulation::Road> road;
  std::vector<VehiclePose> poses;
  std::vector<TrackedObjects> sweeps;
};

LogContent read_log(const std::filesystem::path& log, const LogOptions& options, LeftOut& left_out) {
  LogContent content;
  if (!options.truth.empty()) content.road = simulation::load_argoverse2(log, left_out);
  if (options.out.empty()) return content;
  content.poses = simulation::argoverse2_poses(log, left_out);
  content.sweeps = simulation::argoverse2_objects(log, content.poses, left_out);
  return content;
}

void write_log(const std::filesystem::path& log, const LogOptions& options, const LogContent& content) {
  const std::string out = file_of_log(options.out, options.directory, log, ".mcap");
  const std::string truth = file_of_log(options.truth, options.directory, log, ".truth.json");
  const auto write_drive = [&] {
    if (out.empty()) return;
    warn_of(out, imports::write_drive(out, content.poses, {}, {.objects = content.sweeps}, options.strict));
    fmt::print("{}: {} poses, {} sweeps with objects\n", log.string(), content.poses.size(),
               content.sweeps.size());
  };
  if (truth.empty()) return write_drive();
  io::make_file(truth, [&] {
    save_truth(truth, *content.road);
    write_drive();
  });
}

/// The content of a log, which is all of the import, or one of several. None: that one is broken, and told.
std::optional<LogContent> read_or_leave_out(const std::filesystem::path& log, bool is_all,
                                            const LogOptions& options) {
  const auto read = [&](LeftOut& left_out) { return read_log(log, options, left_out); };
  try {
    return read_and_warn(log, options.strict, read);
  } catch (const std::runtime_error& error) {
    if (is_all || options.strict) throw;
    fmt::print(stderr, "laneloom: {}; the log is left out\n", io::printable(error.what()));
    return std::nullopt;
  }
}

void import_argoverse2(const LogOptions& options) {
  const auto logs = read_and_warn(options.directory, options.strict, [&](LeftOut& left_out) {
    return simulation::argoverse2_logs(options.directory, left_out);
  });
  support::ProgressBar bar;
  std::size_t done = 0, imported = 0;
  for (const auto& log : logs) {
    bar.clear();
    if (const auto content = read_or_leave_out(log, logs.size() == 1, options)) {
      write_log(log, options, *content);
      ++imported;
    }
    bar.step(static_cast<double>(++done) / static_cast<double>(logs.size()));
  }
  if (imported == 0) throw std::runtime_error(options.directory + ": no log of it can be read");
}

void add_argoverse2(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("argoverse2", "Map, poses and annotated objects of an Argoverse 2 log");
  const auto options = std::make_shared<LogOptions>();
  command->add_option("directory", options->directory, "Directory of the log, or of logs")->required();
  CLI::Option_group* outputs = command->add_option_group("Outputs", "one or both");
  outputs->add_option("--out", options->out, "Recording of the poses and objects to write (.mcap)");
  outputs->add_option("--truth", options->truth, "Truth of the road to write (.json)");
  outputs->require_option(1, 2);
  add_strict(*command, options->strict);
  command->footer("For a directory of logs, --out and --truth are folders, with a file per log.");
  command->callback([options] { import_argoverse2(*options); });
}

}  // namespace

void add_import(CLI::App& app) {
  CLI::App* command = app.add_subcommand("import", "Makes recordings of other projects' data");
  command->require_subcommand(1);
  add_argoverse2(*command);
  add_results(*command, "maptr", "MapTR or MapTRv2", "…map_results.json", imports::read_maptr);
  const auto streammapnet = [](const std::filesystem::path& results, const imports::ResultsReading& reading) {
    return read_streammapnet(results, imports::StreamNetwork::streammapnet, reading);
  };
  const auto maptracker = [](const std::filesystem::path& results, const imports::ResultsReading& reading) {
    return read_streammapnet(results, imports::StreamNetwork::maptracker, reading);
  };
  add_results(*command, "streammapnet", "StreamMapNet", "submission_vector.json", streammapnet);
  add_results(*command, "maptracker", "MapTracker", "submission_vector.json", maptracker);
  add_openpilot(*command);
  add_import_frames(*command);
  add_import_scene(*command);
}

}  // namespace laneloom::commands
