#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "base/left_out.hpp"
#include "check/correction.hpp"
#include "check/drive.hpp"
#include "laneloom/config.hpp"

namespace laneloom::check {

/// Something about a drive that is wrong, and what to do about it.
struct Finding {
  std::string id;       ///< stable, for machines
  std::string found;    ///< sentences
  std::string remedy;   ///< likewise; it names an option or a key
  bool advice = false;  ///< nothing is wrong
};
using Findings = std::vector<Finding>;

/// The id of the advice that too little is seen or driven to tell whether frames fit together.
inline constexpr const char* kTooLittle = "too_little";

/// Names the command that writes a drive anew with a correction.
using CommandFor = std::function<std::string(const Correction& correction)>;

/// `laneloom import frames` with its options, which takes any drive.
std::string import_frames_command(const Correction& correction);

/// All that is found about each source of a drive, the likeliest cause first. Remedies name `command_for`.
Findings findings(const Drive& drive, const Config& config,
                  const CommandFor& command_for = import_frames_command);

/// Whether more than a twentieth of a drive cannot be read.
Findings left_out_findings(const Drive& drive, const LeftOut& left_out);

/// What is found of conventions alone, and not of stamps and of jumps. None without detections or poses.
Findings fit_findings(const Drive& drive, const MapperConfig& mapper);

/// How far the points' frame of each source lies to the left in the body frame, in metres. A source whose
/// points need no correction, or another one, is not in it.
std::map<std::string, double> sensor_offsets(const Drive& drive, const MapperConfig& mapper);

/// What is wrong with stamps: their order, gaps and rates.
///@{
Findings frame_stamp_findings(const std::vector<DetectionFrame>& frames,
                              const std::vector<VehiclePose>& poses, const SyncConfig& sync);
Findings pose_stamp_findings(const std::vector<VehiclePose>& poses);
///@}

/// Messages of objects that are refused, and moving objects none of which leaves a trail.
Findings object_findings(const std::vector<TrackedObjects>& objects, const GateConfig& gate);

/// Poses that jump.
Findings jump_findings(const PoseTrack& poses, const Correction& correction);

/// The conventions by which the frames of a source agree better with one another, each with its finding. They
/// are put into `correction`.
Findings convention_findings(const std::vector<DetectionFrame>& frames, const PoseTrack& poses,
                             Correction& correction);

/// Confidences that are no shares, or too low to be used. The scale is put into `correction`.
Findings confidence_findings(const std::vector<DetectionFrame>& frames, const PreprocessConfig& preprocess,
                             Correction& correction);

/// A lane of the vehicle that is narrower or wider than a lane may be, and a vehicle beside the middle of its
/// lane. The offset is put into `correction`.
Findings lane_findings(const std::vector<DetectionFrame>& frames, const PoseTrack& poses,
                       const LaneConfig& lane, Correction& correction);

}  // namespace laneloom::check
