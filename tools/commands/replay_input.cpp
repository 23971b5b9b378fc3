#include "commands/replay_input.hpp"

#include <optional>
#include <utility>

#include "commands/warn_of.hpp"
#include "replay/message_source.hpp"

namespace laneloom::commands {

void replay_input(const std::string& path, const Config& config, replay::Replay& replay) {
  const auto source = replay::open_messages(path, config.dds.map_frame_id);
  while (std::optional<recording::RecordedMessage> message = source->next_input())
    replay.add(std::move(*message));
  warn_of(path, source->refused(), source->cut_off());
  warn_of(path, source->left_out());
}

}  // namespace laneloom::commands
