#include "laneloom/dds/participant.hpp"

#include <fastdds/dds/domain/DomainParticipantFactory.hpp>

#include <stdexcept>

#include "dds/participant_impl.hpp"
#include "dds/qos.hpp"

namespace laneloom::dds {

using namespace eprosima::fastdds::dds;

void check_files(const DdsConfig& config) { participant_qos(config, ""); }

Participant::Participant(const DdsConfig& config, const std::string& name)
    : impl_(std::make_shared<Impl>(config, name)) {}

Participant::Impl::Impl(const DdsConfig& config, const std::string& name)
    : map_frame_id_(config.map_frame_id), security_directory_(config.security_directory) {
  const auto qos = participant_qos(config, name);
  participant_ = DomainParticipantFactory::get_instance()->create_participant(
      static_cast<DomainId_t>(config.domain), qos);
  if (!participant_) throw refusal("participant in domain " + std::to_string(config.domain));

  PublisherQos publisher_qos = PUBLISHER_QOS_DEFAULT;
  publisher_qos.partition().push_back(config.vehicle_id.c_str());
  publisher_ = participant_->create_publisher(publisher_qos);
  SubscriberQos subscriber_qos = SUBSCRIBER_QOS_DEFAULT;
  subscriber_qos.partition().push_back(config.vehicle_id.c_str());
  subscriber_ = participant_->create_subscriber(subscriber_qos);
  if (!publisher_ || !subscriber_) {
    close();
    throw refusal("publisher or subscriber");
  }
}

Participant::Impl::~Impl() { close(); }

void Participant::Impl::close() {
  participant_->delete_contained_entities();
  DomainParticipantFactory::get_instance()->delete_participant(participant_);
}

Topic* Participant::Impl::topic(const std::string& name, const TypeSupport& type) {
  if (auto* known = dynamic_cast<Topic*>(participant_->lookup_topicdescription(name))) return known;
  participant_->register_type(type);
  auto* topic = participant_->create_topic(name, type.get_type_name(), TOPIC_QOS_DEFAULT);
  if (!topic) throw refusal("topic " + name);
  return topic;
}

std::runtime_error Participant::Impl::refusal(const std::string& entity) const {
  std::string text = "DDS refused to make a " + entity;
  if (!security_directory_.empty()) {
    text += "; dds.security_directory: not valid, or not permitted to the identity in " + security_directory_;
  }
  return std::runtime_error(text);
}

}  // namespace laneloom::dds
