#pragma once

#include <filesystem>
#include <functional>

#include "base/left_out.hpp"
#include "laneloom/counters.hpp"
#include "laneloom/next_turn.hpp"
#include "laneloom/objects.hpp"
#include "laneloom/types.hpp"

/// Reads the input of an evaluation from files of either kind: JSON lines (io/json_lines.hpp) or a recording
/// (recording/recording.hpp), told apart by their first bytes. All functions leave
/// out what is wrong, and throw std::runtime_error naming the file if it cannot be read.
namespace laneloom::evaluation {

/// The number of frames or maps, and the messages of a recording that could not be read.
struct InputAccount {
  std::size_t count = 0;  ///< of frames, objects or maps in the file, visited or not
  Counters refused;       ///< messages that were refused, by "<topic>: <reason>"
  LeftOut left_out;       ///< damaged parts of a recording, or lines that are no frames or maps
};

/// How an input is read.
struct InputReading {
  bool strict = false;  ///< the first thing that is wrong is an error
  /// Is called for each frame, map or message with the share of the file that was read, 0..1.
  std::function<void(double share)> on_step = [](double /*share*/) {};
};

/// Calls visit() for every frame with T_map_body at its stamp, in the order of the stamps. Several sources
/// may have frames at one stamp. A frame that is not later than one before it is left out. Of a recording,
/// only frames and poses that a service would believe are used; frames without poses around them are left
/// out.
InputAccount for_each_frame(const std::filesystem::path& path,
                            const std::function<void(const DetectionFrame&, const Eigen::Isometry3d&)>& visit,
                            const InputReading& reading = {});

/// Calls visit() for every message of objects with T_map_body at its stamp, in the order of the stamps. Of a
/// recording, only those that a service would believe are used.
InputAccount for_each_objects(
    const std::filesystem::path& path,
    const std::function<void(const TrackedObjects&, const Eigen::Isometry3d&)>& visit,
    const InputReading& reading = {});

/// Does the same for every message of the route's next turn.
InputAccount for_each_next_turn(const std::filesystem::path& path,
                                const std::function<void(const NextTurn&, const Eigen::Isometry3d&)>& visit,
                                const InputReading& reading = {});

/// Calls visit() for every map. Maps before the first fused frame (stamp 0), and maps older than one before
/// them, are left out. Of several maps with one stamp, the last one is used.
InputAccount for_each_map(const std::filesystem::path& path,
                          const std::function<void(const LocalMap&)>& visit,
                          const InputReading& reading = {});

}  // namespace laneloom::evaluation
