#include "commands/recorded_configuration.hpp"

#include <memory>
#include <optional>
#include <string_view>
#include <variant>

#include "config/config_file.hpp"
#include "laneloom/dds/cdr.hpp"
#include "recording/topics.hpp"
#include "replay/message_source.hpp"

namespace laneloom::commands {

std::string told_configuration(const std::string& path, const ServiceStatus& status) {
  return config::dump(config::from_settings(status.configuration, path + ": the service's configuration"));
}

std::string recorded_configuration(const std::string& path) {
  if (!recording::is_recording(path)) return {};
  const auto source = replay::open_messages(path, "map");
  if (std::string told = source->origin().configuration; !told.empty()) return told;
  const std::size_t of_status = recording::kTopicIndex<ServiceStatus>;
  while (const auto message = source->next_raw()) {
    ServiceStatus status;
    if (message->topic == of_status && dds::from_cdr(message->bytes, "map", status).empty() &&
        !status.configuration.empty())
      return told_configuration(path, status);
  }
  return {};
}

Config recorded_config(const std::string& path) {
  return config::parse_config(recorded_configuration(path), path + ": its configuration");
}

}  // namespace laneloom::commands
