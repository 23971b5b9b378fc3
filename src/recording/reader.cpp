#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "base/seconds.hpp"
#include "laneloom/dds/cdr.hpp"
#include "recording/damage.hpp"
#include "recording/mcap_format.hpp"
#include "recording/mcap_reader.hpp"
#include "recording/recording.hpp"
#include "recording/topics.hpp"

namespace laneloom::recording {
namespace {

constexpr std::string_view kForeignTopic = "not a topic of laneloom";
constexpr std::string_view kOtherVersion = "another version of the topics";
constexpr std::string_view kTopicsOfAnyVersion = "laneloom/v";
/// The prefix of types for viewers alone. Their topics are made from laneloom's, so that passing over them
/// loses nothing.
constexpr std::string_view kViewersTypes = "foxglove::";

template <class T>
constexpr bool kIsInput = std::is_same_v<T, DetectionFrame> || std::is_same_v<T, VehiclePose> ||
                          std::is_same_v<T, TrackedObjects> || std::is_same_v<T, NextTurn>;

/// Why a message of a channel with the topic's name is refused. Empty: it is not refused. The name alone does
/// not tell that the channel is the topic's.
template <class T>
std::string_view refusal(const McapMessage& message) {
  const McapChannel& channel = *message.channel;
  if (channel.message_encoding != kCdr) return "unknown encoding";
  if (!channel.schema || channel.schema->name != topic_of<T>().type) return "another type";
  if (message.log_time_ns > static_cast<std::uint64_t>(kMaxStamp_ns)) return "log time";
  return "";
}

}  // namespace

bool is_recording(const std::string& path) {
  std::error_code not_there;
  if (std::filesystem::is_fifo(path, not_there))  // its first bytes would be lost
    throw std::runtime_error(path + ": is a pipe; - stands for standard input, which may be one");
  std::array<char, kMcapMagic.size()> begin{};
  std::ifstream(path, std::ios::binary).read(begin.data(), begin.size());
  return std::ranges::equal(begin, kMcapMagic, {}, [](char c) { return static_cast<std::uint8_t>(c); });
}

class RecordingReader::Impl {
 public:
  Impl(const std::string& path, std::string map_frame_id, const RecordingLimits& limits)
      : path_(path), map_frame_id_(std::move(map_frame_id)), file_(path, limits) {}

  std::optional<RecordedMessage> next(bool inputs_only) {
    while (const auto message = next_of_file()) {
      RecordedMessage recorded{static_cast<std::int64_t>(message->log_time_ns),
                               static_cast<std::int64_t>(message->publish_time_ns),
                               {}};
      bool passed_over = false;
      const auto convert = [&]<class T>(std::in_place_type_t<T> /*type*/) {
        passed_over = inputs_only && !kIsInput<T>;
        if (std::is_same_v<T, VehiclePose> && map_frame_id_.empty())
          map_frame_id_ = dds::frame_of_pose(message->data);
        return passed_over ? std::string_view()
                           : dds::from_cdr(message->data, map_frame_id_, recorded.message.emplace<T>());
      };
      if (accept(*message, convert) && !passed_over) return recorded;
    }
    return std::nullopt;
  }

  std::optional<RawMessage> next_raw() {
    while (const auto message = next_of_file()) {
      RawMessage raw{static_cast<std::int64_t>(message->log_time_ns), 0, {}};
      const auto copy = [&]<class T>(std::in_place_type_t<T> /*type*/) {
        raw.topic = kTopicIndex<T>;
        raw.bytes.assign(message->data.begin(), message->data.end());
        return std::string_view();
      };
      if (accept(*message, copy)) return raw;
    }
    return std::nullopt;
  }

  Origin origin() const {
    const auto found = file_.metadata().find(kOriginName);
    if (found == file_.metadata().end()) return {};
    const auto text = [&](const char* key) {
      const auto entry = found->second.find(key);
      return entry == found->second.end() ? std::string() : entry->second;
    };
    return {text(kVersionKey), text(kConfigurationKey)};
  }
  const Counters& refused() const { return refused_; }
  double progress() const { return file_.progress(); }

 private:
  /// Whether the message is one of laneloom's, and `take`, which is called with its type, names no reason to
  /// refuse it.
  template <class Take>
  bool accept(const McapMessage& message, const Take& take) {
    if (message.channel->schema && message.channel->schema->name.starts_with(kViewersTypes)) return false;
    const auto reason = take_if_of<Take, DetectionFrame, VehiclePose, PublishedMap, RoadMarkings,
                                   ServiceStatus, TrackedObjects, NextTurn>(message, take);
    if (reason.empty()) return true;
    refused_.add(message.channel->topic + ": " + std::string(reason));
    return false;
  }

  template <class Take, class T, class... Others>
  static std::string_view take_if_of(const McapMessage& message, const Take& take) {
    if (topic_of<T>().is_called(message.channel->topic)) {
      const auto reason = refusal<T>(message);
      return reason.empty() ? take(std::in_place_type<T>) : reason;
    }
    if constexpr (sizeof...(Others) > 0) return take_if_of<Take, Others...>(message, take);
    return message.channel->topic.starts_with(kTopicsOfAnyVersion) ? kOtherVersion : kForeignTopic;
  }

  /// Throws Damage at the end of a file that is cut off, once.
  std::optional<McapMessage> next_of_file() {
    auto message = file_.next();
    if (!message && file_.cut_off() && !std::exchange(told_of_end_, true))
      throw Damage(path_, "its end", "the recording is cut off");
    return message;
  }

  std::string path_, map_frame_id_;
  McapReader file_;
  bool told_of_end_ = false;  ///< that it is missing
  Counters refused_;
};

RecordingReader::RecordingReader(const std::string& path, std::string map_frame_id,
                                 const RecordingLimits& limits)
    : impl_(std::make_unique<Impl>(path, std::move(map_frame_id), limits)) {}
RecordingReader::RecordingReader(RecordingReader&&) noexcept = default;
RecordingReader& RecordingReader::operator=(RecordingReader&&) noexcept = default;
RecordingReader::~RecordingReader() = default;

std::optional<RecordedMessage> RecordingReader::next() { return impl_->next(false); }
std::optional<RecordedMessage> RecordingReader::next_input() { return impl_->next(true); }
std::optional<RawMessage> RecordingReader::next_raw() { return impl_->next_raw(); }
Origin RecordingReader::origin() const { return impl_->origin(); }
const Counters& RecordingReader::refused() const { return impl_->refused(); }
double RecordingReader::progress() const { return impl_->progress(); }

}  // namespace laneloom::recording
