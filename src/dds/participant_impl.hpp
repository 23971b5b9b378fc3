#pragma once

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <memory>
#include <stdexcept>
#include <string>

#include "dds/guarded_transport.hpp"
#include "laneloom/dds/participant.hpp"

namespace laneloom::dds {

class Participant::Impl {
 public:
  /// An empty vehicle id gives no partition. `user_data` is announced with the participant.
  Impl(const DdsConfig& config, const std::string& name, Presence presence,
       const std::string& user_data = {});
  ~Impl();
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  /// The topic of this name. It is made at its first use. Throws as Participant(), and ConfigError if it has
  /// another type, or one with samples of another kind.
  eprosima::fastdds::dds::Topic* topic(const std::string& name,
                                       const eprosima::fastdds::dds::TypeSupport& type);

  eprosima::fastdds::dds::DomainParticipant& participant() { return *participant_; }
  eprosima::fastdds::dds::Publisher& publisher() { return *publisher_; }
  eprosima::fastdds::dds::Subscriber& subscriber() { return *subscriber_; }
  const std::string& map_frame_id() const { return map_frame_id_; }
  /// For DDS-Security.
  bool has_identity() const { return !security_directory_.empty(); }
  Counters refused_datagrams() const { return door_->refused(); }
  SelfCheck ask_itself() { return door_->probe().ask(); }
  /// Throws, as Participant() does, because DDS made no `entity`. DDS itself does not tell why.
  [[noreturn]] void refuse(const std::string& entity) const;

 private:
  void close();
  void check_support(const std::string& topic, const eprosima::fastdds::dds::TypeSupport& type) const;

  std::string map_frame_id_;
  std::string security_directory_;
  std::shared_ptr<Door> door_;
  eprosima::fastdds::dds::DomainParticipant* participant_ = nullptr;
  eprosima::fastdds::dds::Publisher* publisher_ = nullptr;
  eprosima::fastdds::dds::Subscriber* subscriber_ = nullptr;
};

}  // namespace laneloom::dds
