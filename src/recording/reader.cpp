#include <utility>

#include "laneloom/dds/cdr.hpp"
#include "laneloom/recording.hpp"
#include "recording/mcap_reader.hpp"
#include "recording/topics.hpp"

namespace laneloom {
namespace {

constexpr std::string_view kForeignTopic = "not a topic of laneloom";

/// A channel that has the topic's name, but another type or encoding, would be taken for what it is not.
template <class T>
std::string_view refusal(const McapChannel& channel) {
  if (channel.message_encoding != kCdr) return "unknown encoding";
  if (!channel.schema || channel.schema->name != topic_of<T>().type) return "another type";
  return "";
}

}  // namespace

class RecordingReader::Impl {
 public:
  Impl(const std::string& path, std::string map_frame_id, const RecordingLimits& limits)
      : map_frame_id_(std::move(map_frame_id)), file_(path, limits) {}

  std::optional<RecordedMessage> next() {
    while (const auto message = file_.next()) {
      RecordedMessage recorded{static_cast<std::int64_t>(message->log_time_ns),
                               static_cast<std::int64_t>(message->publish_time_ns),
                               {}};
      const std::string_view reason = convert(*message, recorded);
      if (reason.empty()) return recorded;
      refused_.add(message->channel->topic + ": " + std::string(reason));
    }
    return std::nullopt;
  }

  const Counters& refused() const { return refused_; }
  bool cut_off() const { return file_.cut_off(); }
  double progress() const { return file_.progress(); }

 private:
  std::string_view convert(const McapMessage& from, RecordedMessage& to) const {
    return convert_if_of<DetectionFrame, VehiclePose, PublishedMap, RoadMarkings, ServiceStatus>(from, to);
  }

  template <class T, class... Others>
  std::string_view convert_if_of(const McapMessage& from, RecordedMessage& to) const {
    if (from.channel->topic == topic_of<T>().name) {
      const auto reason = refusal<T>(*from.channel);
      return reason.empty() ? dds::from_cdr(from.data, map_frame_id_, to.message.template emplace<T>())
                            : reason;
    }
    if constexpr (sizeof...(Others) > 0) return convert_if_of<Others...>(from, to);
    return kForeignTopic;
  }

  std::string map_frame_id_;
  McapReader file_;
  Counters refused_;
};

RecordingReader::RecordingReader(const std::string& path, std::string map_frame_id,
                                 const RecordingLimits& limits)
    : impl_(std::make_unique<Impl>(path, std::move(map_frame_id), limits)) {}
RecordingReader::RecordingReader(RecordingReader&&) noexcept = default;
RecordingReader& RecordingReader::operator=(RecordingReader&&) noexcept = default;
RecordingReader::~RecordingReader() = default;

std::optional<RecordedMessage> RecordingReader::next() { return impl_->next(); }
const Counters& RecordingReader::refused() const { return impl_->refused(); }
bool RecordingReader::cut_off() const { return impl_->cut_off(); }
double RecordingReader::progress() const { return impl_->progress(); }

}  // namespace laneloom
