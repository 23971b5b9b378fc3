#include "commands/replay_input.hpp"

#include <optional>
#include <utility>

#include "commands/warn_of.hpp"
#include "replay/message_source.hpp"

namespace laneloom {

void replay_input(const std::string& path, const Config& config, Replay& replay) {
  const auto source = open_messages(path, config.dds.map_frame_id);
  while (std::optional<RecordedMessage> message = source->next_input()) replay.add(std::move(*message));
  warn_of(path, source->refused(), source->cut_off());
}

}  // namespace laneloom
