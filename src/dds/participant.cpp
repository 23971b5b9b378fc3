#include "laneloom/dds/participant.hpp"

#include <fastdds/dds/domain/DomainParticipantFactory.hpp>

#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <typeinfo>

#include "dds/fast_dds.hpp"
#include "dds/identity_check.hpp"
#include "dds/participant_impl.hpp"
#include "dds/qos.hpp"
#include "laneloom/error.hpp"

namespace laneloom::dds {

using namespace eprosima::fastdds::dds;
using eprosima::fastdds::rtps::DiscoveryProtocol;

void check_files(const DdsConfig& config) { participant_qos(config, ""); }

void check_profile_file(const DdsConfig& config) {
  std::error_code unknown;
  if (!config.profile_file.empty() && !std::filesystem::is_regular_file(config.profile_file, unknown))
    throw ConfigError("dds.profile_file: there is no file " + config.profile_file);
}

Participant::Participant(const DdsConfig& config, const std::string& name, Presence presence) {
  check_values(config);
  impl_ = std::make_shared<Impl>(config, name, presence);
}

Counters Participant::refused_datagrams() const { return impl_->refused_datagrams(); }

SelfCheck Participant::ask_itself() { return impl_->ask_itself(); }

Participant::Impl::Impl(const DdsConfig& config, const std::string& name, Presence presence,
                        const std::string& user_data)
    : map_frame_id_(config.map_frame_id), security_directory_(config.security_directory) {
  auto qos = participant_qos(config, name);
  set_user_data(user_data, qos);
  if (presence == Presence::hidden)
    qos.wire_protocol().builtin.discovery_config.discoveryProtocol = DiscoveryProtocol::NONE;
  door_ = guard_transports(qos, governance_protects_messages(config.security_directory));
  door_->shut();  // Fast DDS announces a participant before it listens
  participant_ = DomainParticipantFactory::get_instance()->create_participant(
      static_cast<DomainId_t>(config.domain), qos);
  if (!participant_) refuse("participant in domain " + std::to_string(config.domain));
  door_->open();

  PublisherQos publisher_qos = PUBLISHER_QOS_DEFAULT;
  if (!config.vehicle_id.empty()) publisher_qos.partition().push_back(config.vehicle_id.c_str());
  publisher_ = participant_->create_publisher(publisher_qos);
  SubscriberQos subscriber_qos = SUBSCRIBER_QOS_DEFAULT;
  if (!config.vehicle_id.empty()) subscriber_qos.partition().push_back(config.vehicle_id.c_str());
  subscriber_ = participant_->create_subscriber(subscriber_qos);
  if (!publisher_ || !subscriber_) {
    close();
    refuse("publisher or subscriber");
  }
}

Participant::Impl::~Impl() { close(); }

void Participant::Impl::close() {
  look_for_interfaces(*participant_);
  participant_->delete_contained_entities();
  DomainParticipantFactory::get_instance()->delete_participant(participant_);
}

Topic* Participant::Impl::topic(const std::string& name, const TypeSupport& type) {
  check_support(name, type);
  if (auto* known = dynamic_cast<Topic*>(participant_->lookup_topicdescription(name))) {
    if (known->get_type_name() == type.get_type_name()) return known;
    throw ConfigError("topic " + name + " cannot have two types: " + known->get_type_name() + " and " +
                      type.get_type_name());
  }
  participant_->register_type(type);
  auto* topic = participant_->create_topic(name, type.get_type_name(), TOPIC_QOS_DEFAULT);
  if (!topic) refuse("topic " + name);
  return topic;
}

/// A participant makes the samples of all its readers of a type by one type support. Two supports of one type
/// differ in what a sample is.
void Participant::Impl::check_support(const std::string& topic, const TypeSupport& type) const {
  const TypeSupport known = participant_->find_type(type.get_type_name());
  if (known.empty()) return;
  const TopicDataType &first = *known, &second = *type;
  if (typeid(first) != typeid(second))
    throw ConfigError("topic " + topic + " cannot be used both raw and not raw by one participant");
}

void Participant::Impl::refuse(const std::string& entity) const {
  const std::string text = "DDS refused to make a " + entity;
  if (security_directory_.empty()) throw std::runtime_error(text);
  const std::string problem = identity_problem(security_directory_);
  throw NotPermitted(
      text + "; dds.security_directory: " + (problem.empty() ? "not permitted to the identity" : problem) +
      ", in " + security_directory_);
}

}  // namespace laneloom::dds
