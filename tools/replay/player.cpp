#include "replay/player.hpp"

#include <cmath>

namespace laneloom::replay {
namespace {

template <class T>
bool is(const recording::RawMessage& message) {
  static const std::size_t topic = recording::AnyMessage(std::in_place_type<T>).index();
  return message.topic == topic;
}

}  // namespace

bool has_objects(MessageSource& source) {
  while (const auto message = source.next_raw())
    if (is<TrackedObjects>(*message)) return true;
  return false;
}

Player::Player(const DdsConfig& dds, double speed_up, bool with_objects)
    : participant_(dds, "laneloom replay"),
      objects_(with_objects ? std::make_unique<dds::RawWriter<TrackedObjects>>(participant_) : nullptr),
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
  } else if (is<TrackedObjects>(message) && objects_ && !objects_->write(message.bytes)) {
    ++not_taken_;
  }
}

}  // namespace laneloom::replay
