#include "commands/import_frames.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "check/correction.hpp"
#include "check/drive.hpp"
#include "commands/class_option.hpp"
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
      options.drive, "map",
      {.strict = options.strict, .conventions = {.any_confidence = true, .classes = options.classes}});
}

/// All frames, corrected, in the order of their stamps.
std::vector<DetectionFrame> corrected_frames(const check::Drive& drive, const check::PoseTrack& poses,
                                             const check::Correction& correction, std::size_t& without_pose) {
  std::vector<DetectionFrame> frames;
  for (const auto& [source, of_source] : drive.frames)
    for (const DetectionFrame& frame : of_source) {
      const auto pose = poses.at(frame.stamp_ns, correction);
      if (pose || !correction.points_in_map)
        frames.push_back(corrected(frame, correction, pose.value_or(Eigen::Isometry3d::Identity())));
      else
        ++without_pose;
    }
  std::ranges::stable_sort(frames, {}, &DetectionFrame::stamp_ns);
  return frames;
}

void import_frames(const ImportFramesOptions& options) {
  const auto source = open_drive(options);
  const check::Drive drive = read_inputs(*source);
  warn_of(options.drive, source->refused(), source->cut_off());
  warn_of(options.drive, source->left_out());
  const check::PoseTrack track(drive.poses);
  std::vector<VehiclePose> poses = track.poses();
  for (VehiclePose& pose : poses) pose = corrected(pose, options.correction);
  std::size_t without_pose = 0;
  std::vector<DetectionFrame> frames = corrected_frames(drive, track, options.correction, without_pose);
  without_pose += imports::drop_frames_without_pose(frames, poses);
  if (frames.empty()) throw std::runtime_error(options.drive + ": no frame is within the poses");
  imports::write_drive(options.out, poses, frames);
  fmt::print("{}: {} frames, {} poses\n", options.out, frames.size(), poses.size());
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
  command->add_option("--out", options->out, "Recording to write (.mcap)")->required();
  add_points(*command, options->correction);
  add_poses(*command, options->correction);
  add_classes(*command, options->classes);
  add_strict(*command, options->strict);
  command->callback([options] { import_frames(*options); });
}

}  // namespace laneloom::commands
