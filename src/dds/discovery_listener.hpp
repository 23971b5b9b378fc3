#pragma once

#include <fastdds/dds/domain/DomainParticipantListener.hpp>

#include "dds/fast_dds.hpp"
#if LANELOOM_FAST_DDS == 3
#include <fastdds/rtps/builtin/data/ParticipantBuiltinTopicData.hpp>
#include <fastdds/rtps/builtin/data/PublicationBuiltinTopicData.hpp>
#include <fastdds/rtps/builtin/data/SubscriptionBuiltinTopicData.hpp>
#include <fastdds/rtps/participant/ParticipantDiscoveryInfo.hpp>
#include <fastdds/rtps/reader/ReaderDiscoveryStatus.hpp>
#include <fastdds/rtps/writer/WriterDiscoveryStatus.hpp>
#else
#include <fastdds/rtps/participant/ParticipantDiscoveryInfo.h>
#include <fastdds/rtps/reader/ReaderDiscoveryInfo.h>
#include <fastdds/rtps/writer/WriterDiscoveryInfo.h>
#endif

namespace laneloom::dds {

#if LANELOOM_FAST_DDS == 2
/// The data that a participant announces of itself, by the names of Fast DDS 3.
struct DiscoveredParticipant {
  explicit DiscoveredParticipant(const eprosima::fastdds::rtps::ParticipantProxyData& data)
      : guid(data.m_guid),
        participant_name(data.m_participantName),
        default_locators(data.default_locators) {}

  const eprosima::fastdds::rtps::GUID_t& guid;
  const eprosima::fastrtps::string_255& participant_name;
  const eprosima::fastdds::rtps::RemoteLocatorList& default_locators;
};

/// The data that a writer or a reader announces of itself, by the names of Fast DDS 3.
struct DiscoveredEndpoint {
  template <class ProxyData>
  explicit DiscoveredEndpoint(const ProxyData& data)
      : guid(data.guid()),
        topic_name(data.topicName()),
        type_name(data.typeName()),
        partition(data.m_qos.m_partition),
        reliability(data.m_qos.m_reliability),
        durability(data.m_qos.m_durability),
        deadline(data.m_qos.m_deadline),
        liveliness(data.m_qos.m_liveliness),
        ownership(data.m_qos.m_ownership) {}

  const eprosima::fastdds::rtps::GUID_t& guid;
  const eprosima::fastrtps::string_255 &topic_name, &type_name;
  const eprosima::fastdds::dds::PartitionQosPolicy& partition;
  const eprosima::fastdds::dds::ReliabilityQosPolicy& reliability;
  const eprosima::fastdds::dds::DurabilityQosPolicy& durability;
  const eprosima::fastdds::dds::DeadlineQosPolicy& deadline;
  const eprosima::fastdds::dds::LivelinessQosPolicy& liveliness;
  const eprosima::fastdds::dds::OwnershipQosPolicy& ownership;
};
#endif

/// Hears of other participants, their writers and readers, and tells it to Noting::note_participant() and
/// Noting::note_endpoint().
template <class Noting>
class DiscoveryListener : public eprosima::fastdds::dds::DomainParticipantListener {
  using Participant = eprosima::fastdds::dds::DomainParticipant;
  Noting& noting() { return static_cast<Noting&>(*this); }

#if LANELOOM_FAST_DDS == 3
  using ParticipantStatus = eprosima::fastdds::rtps::ParticipantDiscoveryStatus;
  using WriterStatus = eprosima::fastdds::rtps::WriterDiscoveryStatus;
  using ReaderStatus = eprosima::fastdds::rtps::ReaderDiscoveryStatus;

  void on_participant_discovery(Participant* /*participant*/, ParticipantStatus status,
                                const eprosima::fastdds::dds::ParticipantBuiltinTopicData& data,
                                bool& /*should_be_ignored*/) override {
    noting().note_participant(data, status == ParticipantStatus::DISCOVERED_PARTICIPANT ||
                                        status == ParticipantStatus::CHANGED_QOS_PARTICIPANT);
  }
  void on_data_writer_discovery(Participant* /*participant*/, WriterStatus status,
                                const eprosima::fastdds::dds::PublicationBuiltinTopicData& data,
                                bool& /*should_be_ignored*/) override {
    noting().note_endpoint(data, true, status != WriterStatus::REMOVED_WRITER);
  }
  void on_data_reader_discovery(Participant* /*participant*/, ReaderStatus status,
                                const eprosima::fastdds::dds::SubscriptionBuiltinTopicData& data,
                                bool& /*should_be_ignored*/) override {
    noting().note_endpoint(data, false, status != ReaderStatus::REMOVED_READER);
  }
#else
  using ParticipantInfo = eprosima::fastdds::rtps::ParticipantDiscoveryInfo;
  using WriterInfo = eprosima::fastdds::rtps::WriterDiscoveryInfo;
  using ReaderInfo = eprosima::fastdds::rtps::ReaderDiscoveryInfo;

  void on_participant_discovery(Participant* /*participant*/, ParticipantInfo&& info) override {
    noting().note_participant(DiscoveredParticipant(info.info),
                              info.status == ParticipantInfo::DISCOVERED_PARTICIPANT ||
                                  info.status == ParticipantInfo::CHANGED_QOS_PARTICIPANT);
  }
  void on_publisher_discovery(Participant* /*participant*/, WriterInfo&& info) override {
    noting().note_endpoint(DiscoveredEndpoint(info.info), true, info.status != WriterInfo::REMOVED_WRITER);
  }
  void on_subscriber_discovery(Participant* /*participant*/, ReaderInfo&& info) override {
    noting().note_endpoint(DiscoveredEndpoint(info.info), false, info.status != ReaderInfo::REMOVED_READER);
  }
#endif
};

}  // namespace laneloom::dds
