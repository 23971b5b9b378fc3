#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/left_out.hpp"
#include "recording/recording.hpp"
#include "scene/scene_maker.hpp"

namespace laneloom::scene {

/// Writes messages to a recording, which must have scene_topics() as its extra topics. Throws as
/// RecordingWriter.
void write_scene(const std::vector<SceneMessage>& messages, std::int64_t log_time_ns,
                 recording::RecordingWriter& to);

/// Counts of add_scene().
struct SceneRecordingReport {
  std::uint64_t messages = 0;  ///< of laneloom's topics
  std::uint64_t scenes = 0;    ///< messages of the scene topics
  Counters refused;            ///< messages that are not in the new recording, as RecordingReader counts them
  LeftOut left_out;            ///< damaged parts of `from`
};

/// Copies the recording `from` to `to`: laneloom's messages byte for byte, with scenes made from them. Throws
/// std::runtime_error naming the file if one cannot be read or written, or `to` exists. Calls on_step() for
/// each message with the share of the file that was read, 0..1.
SceneRecordingReport add_scene(
    const std::string& from, const std::string& to, const std::string& map_frame_id,
    const std::function<void(double share)>& on_step = [](double /*share*/) {});

}  // namespace laneloom::scene
