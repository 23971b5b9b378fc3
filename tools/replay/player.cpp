#include "replay/player.hpp"

#include <cmath>

#include "recording/topics.hpp"

namespace laneloom::replay {
namespace {

template <class T>
bool is(const recording::RawMessage& message) {
  return message.topic == recording::kTopicIndex<T>;
}

template <class T>
std::optional<dds::RawWriter<T>> writer_if(bool is_wanted, const dds::Participant& participant) {
  if (!is_wanted) return std::nullopt;
  return dds::RawWriter<T>(participant);
}

}  // namespace

OptionalTopics optional_topics(MessageSource& source) {
  OptionalTopics topics;
  while (!topics.objects || !topics.next_turns) {
    const auto message = source.next_raw();
    if (!message) break;
    topics.objects |= is<TrackedObjects>(*message);
    topics.next_turns |= is<NextTurn>(*message);
  }
  return topics;
}

Player::Player(const DdsConfig& dds, double speed_up, const OptionalTopics& topics)
    : participant_(dds, "laneloom replay"),
      objects_(writer_if<TrackedObjects>(topics.objects, participant_)),
      next_turns_(writer_if<NextTurn>(topics.next_turns, participant_)),
      detections_(participant_),
      poses_(participant_),
      speed_up_(speed_up) {}

std::chrono::steady_clock::time_point Player::due(const recording::RawMessage& message) {
  if (!first_ns_) {
    first_ns_ = message.log_time_ns;
    start_ = std::chrono::steady_clock::now();
  }
  const double elapsed_ns = static_cast<double>(message.log_time_ns - *first_ns_) / speed_up_;
  return start_ + std::chrono::nanoseconds(std::llround(elapsed_ns));
}

void Player::publish(const recording::RawMessage& message) {
  if (is<DetectionFrame>(message)) {
    ++(detections_.write(message.bytes) ? detections_published_ : not_taken_);
  } else if (is<VehiclePose>(message)) {
    ++(poses_.write(message.bytes) ? poses_published_ : not_taken_);
  } else if (is<TrackedObjects>(message) && objects_) {
    not_taken_ += objects_->write(message.bytes) ? 0U : 1U;
  } else if (is<NextTurn>(message) && next_turns_) {
    not_taken_ += next_turns_->write(message.bytes) ? 0U : 1U;
  }
}

}  // namespace laneloom::replay
