#include "laneloom/dds/participant.hpp"

#include <fastdds/dds/domain/DomainParticipantFactory.hpp>

#include <stdexcept>

#include "dds/participant_impl.hpp"
#include "dds/qos.hpp"

namespace laneloom::dds {

using namespace eprosima::fastdds::dds;

Participant::Participant(const DdsConfig& config, const std::string& name)
    : impl_(std::make_shared<Impl>(config, name)) {}

Participant::Impl::Impl(const DdsConfig& config, const std::string& name)
    : map_frame_id_(config.map_frame_id) {
  const auto qos = participant_qos(config, name);
  participant_ = DomainParticipantFactory::get_instance()->create_participant(
      static_cast<DomainId_t>(config.domain), qos);
  if (!participant_) throw std::runtime_error("DDS refused to make a participant");

  PublisherQos publisher_qos = PUBLISHER_QOS_DEFAULT;
  publisher_qos.partition().push_back(config.vehicle_id.c_str());
  publisher_ = participant_->create_publisher(publisher_qos);
  SubscriberQos subscriber_qos = SUBSCRIBER_QOS_DEFAULT;
  subscriber_qos.partition().push_back(config.vehicle_id.c_str());
  subscriber_ = participant_->create_subscriber(subscriber_qos);
  if (!publisher_ || !subscriber_) {
    close();
    throw std::runtime_error("DDS refused to make a publisher or a subscriber");
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
  if (!topic) throw std::runtime_error("DDS refused to make the topic " + name);
  return topic;
}

}  // namespace laneloom::dds
