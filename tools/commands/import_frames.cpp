#include "commands/commands.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "check/correction.hpp"
#include "check/drive.hpp"
#include "commands/class_option.hpp"
#include "commands/given_files.hpp"
#include "commands/options.hpp"
#include "commands/read_input.hpp"
#include "commands/warn_of.hpp"
#include "import/drive_recording.hpp"

namespace laneloom::commands {
namespace {

using check::ConfidenceScale;

const std::map<std::string, ConfidenceScale> kConfidenceScales{{"share", ConfidenceScale::share},
                                                               {"percent", ConfidenceScale::percent},
                                                               {"logit", ConfidenceScale::logit}};

struct ImportFramesOptions {
  std::string drive, out;
  check::Correction correction;
  io::Classes classes;
  bool strict = false;
};

/// Opens a drive whose lines may be of other classes.
std::unique_ptr<replay::MessageSource> open_drive(const ImportFramesOptions& options) {
  if (!options.classes.empty() && recording::is_recording(options.drive))
    throw std::runtime_error(options.drive + ": a recording has laneloom's types; --class needs JSON lines");
  return replay::open_messages(
      options.drive, "",
      {.strict = options.strict, .conventions = {.any_confidence = true, .classes = options.classes}});
}

/// Corrects messages, and puts them in the order of their stamps. Those without poses around them are left
/// out. Returns how many.
template <class Message>
std::size_t correct(std::vector<Message>& messages, const check::PoseTrack& poses,
                    const check::Correction& correction) {
  const std::size_t without_pose = std::erase_if(
      messages, [&](const Message& message) { return !poses.at(message.stamp_ns, correction); });
  for (Message& message : messages) {
    const Eigen::Isometry3d pose = *poses.at(message.stamp_ns, correction);
    message = corrected(std::move(message), correction, pose);
  }
  std::ranges::stable_sort(messages, {}, &Message::stamp_ns);
  return without_pose;
}

std::vector<DetectionFrame> frames_of_all_sources(check::Drive& drive) {
  std::vector<DetectionFrame> frames;
  for (auto& [source, of_source] : drive.frames) std::ranges::move(of_source, std::back_inserter(frames));
  return frames;
}

void import_frames(const ImportFramesOptions& options) {
  refuse_overwriting({options.drive}, {options.out});
  const auto source = open_drive(options);
  check::Drive drive = read_inputs(*source);
  warn_of(options.drive, source->refused(), source->left_out());
  if (const auto runs = check::later_runs(drive.poses); !runs.empty())
    throw std::runtime_error(fmt::format(
        "{}: has {} runs, one behind the other: stamps begin anew at pose {}; make a file of each",
        options.drive, runs.size() + 1, runs.front() + 1));
  const check::PoseTrack track(drive.poses);
  std::vector<VehiclePose> poses = track.poses();
  for (VehiclePose& pose : poses) pose = corrected(pose, options.correction);
  std::vector<DetectionFrame> frames = frames_of_all_sources(drive);
  std::size_t without_pose = correct(frames, track, options.correction);
  correct(drive.objects, track, options.correction);
  correct(drive.next_turns, track, options.correction);
  without_pose += imports::drop_frames_without_pose(frames, poses);
  if (frames.empty()) throw std::runtime_error(options.drive + ": no frame is within the poses");
  const imports::OtherInputs others{std::move(drive.objects), std::move(drive.next_turns)};
  warn_of(options.out, imports::write_drive(options.out, poses, frames, others, options.strict));
  fmt::print("{}: {} frames, {} poses, {} messages of objects\n", options.out, frames.size(), poses.size(),
             others.objects.size());
  if (without_pose > 0) fmt::print("left out: {} frames without poses around them\n", without_pose);
}

void add_points(CLI::App& command, check::Correction& correction) {
  add_axes(command, correction.axes);
  command
      .add_option("--point-scale", correction.point_scale,
                  "Metres per unit of the points; 0.001: millimetres")
      ->check(within(1e-6, 1e6));
  command.add_flag("--points-in-map", correction.points_in_map,
                   "The points are in the map frame, and not in the body frame");
  command
      .add_option("--sensor-left", correction.sensor_left_m,
                  "Place of the points' frame in the body frame: metres to the left")
      ->check(within(-100.0, 100.0));
  command.add_option("--sensor-yaw", correction.sensor_yaw_deg, "Its turn to the left, in degrees")
      ->check(within(-180.0, 180.0));
  command
      .add_option_function<std::string>(
          "--confidence",
          [&correction](const std::string& scale) { correction.confidences = kConfidenceScales.at(scale); },
          "Confidences are shares (0 to 1), percent, or log odds (logit)")
      ->check(CLI::IsMember(kConfidenceScales));
}

void add_poses(CLI::App& command, check::Correction& correction) {
  command.add_option("--pose-scale", correction.pose_scale, "Metres per unit of the positions")
      ->check(within(1e-6, 1e6));
  command
      .add_option("--pose-time", correction.pose_time_s,
                  "Seconds to add to the stamps of poses: below 0 if they are too late")
      ->check(within(-1e6, 1e6));
  command
      .add_option_function<std::string>(
          "--quaternion",
          [&correction](const std::string& order) { correction.scalar_first = order == "wxyz"; },
          "Order in which the orientations are written")
      ->check(CLI::IsMember({"xyzw", "wxyz"}));
}

}  // namespace

void add_import_frames(CLI::App& import) {
  CLI::App* command = import.add_subcommand(
      "frames", "Frames and poses in other conventions: axes, units, clocks (see laneloom check)");
  const auto options = std::make_shared<ImportFramesOptions>();
  command
      ->add_option("--in,drive", options->drive, "Recording (MCAP), or detections and poses (.frames.jsonl)")
      ->required();
  add_recording_output(*command, options->out)->required();
  add_points(*command, options->correction);
  add_poses(*command, options->correction);
  add_classes(*command, options->classes);
  add_strict(*command, options->strict);
  command->callback([options] { import_frames(*options); });
}

}  // namespace laneloom::commands
