#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <new>
#include <span>
#include <string_view>
#include <utility>

#include "AutowarePerceptionMsgsPubSubTypes.hpp"
#include "NavMsgsPubSubTypes.hpp"
#include "dds/checked_type.hpp"
#include "dds/topic_reader.hpp"
#include "ros2/names.hpp"
#include "ros2/odometry.hpp"
#include "ros2/tracked_objects.hpp"

namespace laneloom::ros2 {

/// The generated type support of a message of ROS, made safe as dds::CheckedType does. `is_whole` tells
/// whether a payload can be such a message.
template <class PubSubType, bool (*is_whole)(std::span<const std::uint8_t>)>
class ScannedType : public dds::GeneratedType<PubSubType> {
 public:
  using Sample = dds::Sample<typename PubSubType::type>;
  using Payload = typename dds::GeneratedType<PubSubType>::Payload;

  bool read(Payload& payload, void* data) override {
    auto* sample = static_cast<Sample*>(data);
    sample->refusal = {};
    try {
      const bool whole =
          is_whole({payload.data, payload.length}) && this->read_message(payload, sample->message);
      if (!whole) sample->refusal = "malformed";
    } catch (...) {
      sample->refusal = "malformed";
    }
    return true;
  }
  bool write(const void* data, Payload& payload) override {
    return this->write_message(static_cast<const Sample*>(data)->message, payload);
  }
  std::uint32_t bytes(const void* data) override {
    return this->bytes_of_message(static_cast<const Sample*>(data)->message);
  }
  void* make_sample() override { return new Sample; }
  void delete_sample(void* data) override { delete static_cast<Sample*>(data); }
};

using OdometryType = ScannedType<nav_msgs::msg::dds_::Odometry_PubSubType, is_odometry>;
using ObjectsType =
    ScannedType<autoware_perception_msgs::msg::dds_::TrackedObjects_PubSubType, is_tracked_objects>;

/// Reads messages of ROS as plain types.
template <class Message, class T>
class Input {
 public:
  /// Converts a message. Returns why it is refused; empty: it is not refused.
  using Convert = std::function<std::string_view(Message&&, T&)>;

  Input(std::shared_ptr<dds::Participant::Impl> participant, const dds::TopicDescription& topic,
        dds::ReaderCallbacks<T> callbacks, Convert convert)
      : callbacks_(std::move(callbacks)),
        convert_(std::move(convert)),
        reader_(std::move(participant), topic, take(), {}) {}

 private:
  using Received = dds::Sample<Message>;
  using Readers = dds::TopicReader<Received>;

  typename Readers::Take take() {
    return [this](const dds::WriterId& writer, std::uint64_t number, Received* sample) {
      dds::call(callbacks_.numbered, writer, number);
      if (sample != nullptr) receive(writer, number, *sample);
    };
  }
  void receive(const dds::WriterId& writer, std::uint64_t number, Received& sample) noexcept {
    try {
      T message;
      const auto refusal =
          sample.refusal.empty() ? convert_(std::move(sample.message), message) : sample.refusal;
      if (!refusal.empty()) return dds::call(callbacks_.refused, refusal);
      if (message.session_id == 0) {
        message.session_id = session_of(writer);
        message.sequence = number;
      }
      dds::call(callbacks_.sample, std::move(message));
    } catch (const std::bad_alloc&) {
      dds::call(callbacks_.refused, "malformed");
    }
  }

  dds::ReaderCallbacks<T> callbacks_;
  Convert convert_;
  Readers reader_;  // last, so that no callback meets a destroyed member
};

}  // namespace laneloom::ros2
