#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "base/seconds.hpp"
#include "commands/commands.hpp"
#include "commands/recorded_configuration.hpp"
#include "commands/warn_of.hpp"
#include "io/json_text.hpp"
#include "io/printable.hpp"
#include "laneloom/error.hpp"
#include "recording/topics.hpp"
#include "replay/message_source.hpp"
#include "support/progress_bar.hpp"

namespace laneloom::commands {
namespace {

using recording::kTopicNames;

struct TopicInfo {
  std::uint64_t messages = 0;
  std::optional<std::int64_t> first_ns{}, last_ns{};  ///< log times
  double longest_gap_s = 0.0;
  std::set<std::uint64_t> sessions{};

  double duration_s() const { return messages == 0 ? 0.0 : seconds(*last_ns - *first_ns); }
  double rate_hz() const {
    return duration_s() > 0.0 ? static_cast<double>(messages - 1) / duration_s() : 0.0;
  }
};

struct FileInfo {
  recording::Origin origin{};
  std::array<TopicInfo, kTopicNames.size()> topics{};
  std::set<std::string> sources{};         ///< of detections
  std::optional<ServiceStatus> service{};  ///< the first status that tells a configuration
  std::string configuration{};             ///< that made the maps (YAML); empty: it is not known
  std::string why_none{};                  ///< why it is not known

  void add(const recording::RecordedMessage& message) {
    TopicInfo& topic = topics.at(message.message.index());
    const std::int64_t now_ns = message.log_time_ns;
    if (topic.last_ns) topic.longest_gap_s = std::max(topic.longest_gap_s, seconds(now_ns - *topic.last_ns));
    if (!topic.first_ns) topic.first_ns = now_ns;
    topic.last_ns = now_ns;
    ++topic.messages;
    std::visit([&](const auto& content) { topic.sessions.insert(content.session_id); }, message.message);
    if (const auto* frame = std::get_if<DetectionFrame>(&message.message)) sources.insert(frame->source);
    if (const auto* status = std::get_if<ServiceStatus>(&message.message);
        status != nullptr && !service && !status->configuration.empty())
      service = *status;
  }
};

/// Sets the configuration, or why there is none. As recorded_configuration(), of what was read.
void add_configuration(const std::string& path, FileInfo& info) {
  try {
    info.configuration = info.origin.configuration;
    if (info.configuration.empty() && info.service)
      info.configuration = told_configuration(path, *info.service);
    if (info.configuration.empty()) info.why_none = path + ": nobody tells its configuration";
  } catch (const ConfigError& error) {
    info.why_none = error.what();
  }
}

FileInfo read_info(const std::string& path) {
  const auto source = replay::open_messages(path, "");
  FileInfo info;
  support::ProgressBar bar;
  while (const auto message = source->next()) {
    info.add(*message);
    bar.step(source->progress());
  }
  bar.clear();
  info.origin = source->origin();
  add_configuration(path, info);
  warn_of(path, source->refused(), source->left_out());
  return info;
}

std::string text(const FileInfo& info) {
  std::string text;
  if (!info.origin.version.empty())
    text += fmt::format("written by laneloom {}{}\n", io::printable(info.origin.version),
                        info.configuration.empty() ? "" : ", with its configuration (--configuration)");
  text += fmt::format("{:<26} {:>9} {:>9} {:>8} {:>13} {:>9}\n", "topic", "messages", "seconds", "a second",
                      "longest gap s", "sessions");
  for (std::size_t i = 0; i < kTopicNames.size(); ++i)
    if (const TopicInfo& topic = info.topics.at(i); topic.messages > 0)
      text +=
          fmt::format("{:<26} {:>9} {:>9.1f} {:>8.1f} {:>13.2f} {:>9}\n", kTopicNames.at(i), topic.messages,
                      topic.duration_s(), topic.rate_hz(), topic.longest_gap_s, topic.sessions.size());
  for (const std::string& source : info.sources)
    text += fmt::format("source \"{}\"\n", io::printable(source));
  return text;
}

nlohmann::json as_json(const FileInfo& info) {
  nlohmann::json topics = nlohmann::json::object();
  for (std::size_t i = 0; i < kTopicNames.size(); ++i)
    if (const TopicInfo& topic = info.topics.at(i); topic.messages > 0)
      topics[kTopicNames.at(i)] = {
          {"messages", topic.messages}, {"first_ns", *topic.first_ns},          {"last_ns", *topic.last_ns},
          {"rate_hz", topic.rate_hz()}, {"longest_gap_s", topic.longest_gap_s}, {"sessions", topic.sessions}};
  return {{"version", info.origin.version},
          {"configuration", info.configuration},
          {"topics", topics},
          {"sources", info.sources}};
}

struct InfoOptions {
  std::string drive;
  bool json = false, configuration = false;
};

void info(const InfoOptions& options) {
  const FileInfo info = read_info(options.drive);
  if (options.configuration && info.configuration.empty()) throw std::runtime_error(info.why_none);
  if (options.configuration)
    fmt::print("{}", info.configuration);
  else if (options.json)
    fmt::print("{}\n", io::json_text(as_json(info)));
  else
    fmt::print("{}", text(info));
}

}  // namespace

void add_info(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("info", "Tells what is in a drive: topics, rates, gaps, who wrote it");
  const auto options = std::make_shared<InfoOptions>();
  command
      ->add_option("--in,drive", options->drive, "Recording (MCAP), or detections and poses (.frames.jsonl)")
      ->required();
  CLI::Option* json = command->add_flag("--json", options->json, "One JSON object");
  command
      ->add_flag("--configuration", options->configuration,
                 "The configuration that made the maps of the recording, alone (YAML)")
      ->excludes(json);
  command->callback([options] { info(*options); });
}

}  // namespace laneloom::commands
