#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/left_out.hpp"
#include "import/frame_collector.hpp"
#include "laneloom/types.hpp"

namespace laneloom::imports {

/// A drive of openpilot: the detections of its model, and the poses of its odometry.
struct OpenpilotDrive {
  std::vector<DetectionFrame> frames;  ///< stamps ascend
  std::vector<VehiclePose> poses;      ///< stamps ascend
  std::size_t invalid_frames = 0;      ///< number that openpilot marks as not valid; they are left out
  std::size_t invalid_poses = 0;       ///< likewise
  std::size_t models = 0;              ///< number of modelV2 in the log, also of those that are left out
  std::size_t driving_models = 0;      ///< number of drivingModelData, of which qlogs have more
};

/// The lists of lines in a log, and what they become.
const Classes& openpilot_classes();

/// How a log is read. What it refers to must live as long as the reading.
struct OpenpilotReading {
  LeftOut& left_out;
  const Classes& classes = openpilot_classes();  ///< has a type, or none, for each list
  /// Is called for each event with the share of the file that was read, 0..1.
  std::function<void(double share)> on_step = [](double /*share*/) {};
};

/// Reads a log of openpilot as JSON, one event per line. Cap'n Proto's own tool makes it from the log and
/// openpilot's schema:
///
///     zstdcat rlog.zst | capnp convert --short binary:json openpilot/cereal/log.capnp Event > rlog.jsonl
///
/// Of struct Event, logMonoTime and valid are read, and of its members
/// - modelV2: timestampEof, laneLines and roadEdges (x, y, z), laneLineProbs, laneLineStds, roadEdgeStds;
/// - livePose, or in older logs liveLocationKalman: orientationNED and velocityDevice, with their valid;
/// - liveCalibration: rpyCalib, where calStatus is calibrated.
/// Other events are passed over. Integers of 64 bits are numbers or texts of digits. A list of lines, of
/// probabilities or of standard deviations that is not there is as an empty one; a modelV2 needs laneLines or
/// roadEdges.
///
/// The body frame is openpilot's calibrated frame with y and z turned round (x forward, y left, z up): its
/// origin is the camera, so that the road lies below it by the camera's height. The map frame is level, x
/// north, y west, z up, with its origin at the first pose; positions are the sum of the odometry's
/// velocities, and drift as these do. Across a gap the mean of the velocities around it counts.
///
/// A lane line's confidence is its probability. Road edges have none: theirs is 1 less the standard deviation
/// in metres, and not below 0. The log has one standard deviation for a whole line, at the car: it is every
/// point's.
///
/// What is wrong is left out, and the rest comes: a line that is no event, or is cut off, a frame or a pose
/// of a stamp that came before, a lane line or road edge with a bad value, or without a probability or
/// standard deviation (logs of forks have more lines than probabilities), a velocity or pose that the service
/// would refuse.
///
/// Throws std::runtime_error naming the file if it is no such log, and if no frame or fewer than two poses
/// are left; also of the first wrong value, naming line and key, if `left_out` is strict.
OpenpilotDrive read_openpilot(const std::filesystem::path& path, const OpenpilotReading& reading);

/// What speaks for a qlog, which has few of the frames of a log. Empty: the frames are as many as a log has.
std::string why_qlog(const OpenpilotDrive& drive);

}  // namespace laneloom::imports
