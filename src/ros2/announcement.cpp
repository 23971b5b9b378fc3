#include "ros2/announcement.hpp"

#include <fastdds/dds/subscriber/DataReader.hpp>

#include <algorithm>
#include <iterator>
#include <vector>

#include "RmwDdsCommonHumblePubSubTypes.hpp"
#include "RmwDdsCommonPubSubTypes.hpp"
#include "ros2/topic.hpp"

namespace laneloom::ros2 {
namespace {

using eprosima::fastdds::rtps::GUID_t;

constexpr const char* kTopic = "ros_discovery_info";  // has no prefix "rt/"
constexpr const char* kType = "rmw_dds_common/msg/ParticipantEntitiesInfo";

template <class Gid>
Gid to_gid(const GUID_t& guid) {
  Gid gid;
  gid.data().fill(0);
  auto* const entity =
      std::copy_n(guid.guidPrefix.value, eprosima::fastdds::rtps::GuidPrefix_t::size, gid.data().begin());
  std::copy_n(guid.entityId.value, eprosima::fastdds::rtps::EntityId_t::size, entity);
  return gid;
}

template <class Gid, class Entity>
std::vector<Gid> to_gids(const std::vector<Entity*>& entities) {
  std::vector<Gid> gids;
  std::ranges::transform(entities, std::back_inserter(gids),
                         [](const Entity* entity) { return to_gid<Gid>(entity->guid()); });
  return gids;
}

/// Writes the participant's endpoints, with the message type of one distribution.
template <class Type, class Node, class Gid>
std::unique_ptr<dds::TopicWriter> announce_as(const std::shared_ptr<dds::Participant::Impl>& participant,
                                              const Ros2Config& config) {
  std::vector<eprosima::fastdds::dds::DataWriter*> writers;
  participant->publisher().get_datawriters(writers);
  std::vector<eprosima::fastdds::dds::DataReader*> readers;
  participant->subscriber().get_datareaders(readers);
  Node node;
  node.node_name(kNodeName);
  node.node_namespace(full_namespace(config));
  node.reader_gid_seq(to_gids<Gid>(readers));
  node.writer_gid_seq(to_gids<Gid>(writers));
  typename Type::type info;
  info.gid(to_gid<Gid>(participant->publisher().get_participant()->guid()));
  info.node_entities_info_seq({node});
  auto writer =
      std::make_unique<dds::TopicWriter>(participant, topic<Type>(kTopic, kType, dds::TopicKind::status));
  writer->write(&info);
  return writer;
}

}  // namespace

std::unique_ptr<dds::TopicWriter> announce(const std::shared_ptr<dds::Participant::Impl>& participant,
                                           const Ros2Config& config) {
  namespace humble = rmw_dds_common_humble::msg::dds_;
  namespace newer = rmw_dds_common::msg::dds_;
  if (config.distro == "humble")
    return announce_as<humble::ParticipantEntitiesInfo_PubSubType, humble::NodeEntitiesInfo_, humble::Gid_>(
        participant, config);
  return announce_as<newer::ParticipantEntitiesInfo_PubSubType, newer::NodeEntitiesInfo_, newer::Gid_>(
      participant, config);
}

}  // namespace laneloom::ros2
