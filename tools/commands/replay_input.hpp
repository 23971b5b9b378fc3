#pragma once

#include <string>

#include "laneloom/config.hpp"
#include "replay/replay.hpp"

namespace laneloom::commands {

/// Replays all detections and poses of a recording, or of frames with their poses. Warns of messages that
/// were passed over. Throws as open_messages().
void replay_input(const std::string& path, const Config& config, replay::Replay& replay);

}  // namespace laneloom::commands
