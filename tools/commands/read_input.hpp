#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "check/drive.hpp"
#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "replay/message_source.hpp"
#include "replay/replay.hpp"

/// Reads a whole input with a progress bar, and warns of what was left out. If that is `strict`, nothing is
/// left out, but the first thing that is wrong is an error. All throw std::runtime_error naming the file and
/// the place where it cannot be read.
namespace laneloom::commands {

/// Calls `visit` for all detections and poses of a drive, as open_messages() reads them.
void for_each_input(const std::string& path, const Config& config, bool strict,
                    const std::function<void(recording::RecordedMessage&&)>& visit);

/// Reads all detections and poses of an open drive, and warns of nothing.
check::Drive read_inputs(replay::MessageSource& source);

/// Replays all detections and poses of a drive.
void replay_input(const std::string& path, const Config& config, bool strict, replay::Replay& replay);

/// Calls `visit` as evaluation::for_each_frame() does. Returns the number of frames in the file.
std::size_t for_each_frame(const std::string& path, bool strict,
                           const std::function<void(const DetectionFrame&, const Eigen::Isometry3d&)>& visit);

/// Calls `visit` as evaluation::for_each_map() does. Returns the number of maps in the file.
std::size_t for_each_map(const std::string& path, bool strict,
                         const std::function<void(const LocalMap&)>& visit);

/// Throws std::runtime_error if a map and a frame of its time have the vehicle in two places, as those of two
/// drives do. `T_map_body` is the frame's. `frames` and `maps` are the files' names, for the message.
void check_one_drive(const Eigen::Isometry3d& T_map_body, const LocalMap& map, const std::string& frames,
                     const std::string& maps);

}  // namespace laneloom::commands
