#pragma once

#include <algorithm>
#include <mutex>
#include <set>
#include <string>
#include <utility>

#include "dds/discovery_listener.hpp"

namespace laneloom::ros2 {

/// Hears whether other participants write a topic. The participant must outlive this, which is its only
/// listener.
class OtherWriters : public dds::DiscoveryListener<OtherWriters> {
 public:
  OtherWriters(eprosima::fastdds::dds::DomainParticipant& participant, std::string topic)
      : participant_(participant), topic_(std::move(topic)) {
    participant_.set_listener(this, eprosima::fastdds::dds::StatusMask::none());
  }
  ~OtherWriters() override { participant_.set_listener(nullptr); }
  OtherWriters(const OtherWriters&) = delete;
  OtherWriters& operator=(const OtherWriters&) = delete;

  bool any() const {
    const std::lock_guard lock(mutex_);
    return !writers_.empty();
  }

  template <class Data>
  void note_participant(const Data& data, bool is_there) {
    const std::lock_guard lock(mutex_);
    if (!is_there)
      std::erase_if(writers_, [&](const auto& guid) { return guid.guidPrefix == data.guid.guidPrefix; });
  }
  template <class Data>
  void note_endpoint(const Data& data, bool is_writer, bool is_there) {
    const bool is_own = data.guid.guidPrefix == participant_.guid().guidPrefix;
    if (!is_writer || is_own || data.topic_name.to_string() != topic_) return;
    const std::lock_guard lock(mutex_);
    if (is_there)
      writers_.insert(data.guid);
    else
      writers_.erase(data.guid);
  }

 private:
  eprosima::fastdds::dds::DomainParticipant& participant_;
  std::string topic_;
  mutable std::mutex mutex_;
  std::set<eprosima::fastdds::rtps::GUID_t> writers_;
};

}  // namespace laneloom::ros2
