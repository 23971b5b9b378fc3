#pragma once

#include <fastdds/dds/core/policy/QosPolicies.hpp>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/SampleState.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>

#include <string>
#include <vector>

// Fast DDS 2 (Debian 12) and 3 (Debian 13) as one. The sources use the names of Fast DDS 3, and what is below
// for the rest. generated_type.hpp and discovery_listener.hpp do the same for two of its classes.
#if __has_include(<fastdds/config.hpp>)
#define LANELOOM_FAST_DDS 3
#include <fastdds/config.hpp>
#include <fastdds/rtps/common/Guid.hpp>
#include <fastdds/rtps/transport/ChainingTransport.hpp>
#include <fastdds/rtps/transport/ChainingTransportDescriptor.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.hpp>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.hpp>
#include <fastdds/utils/IPLocator.hpp>
#else
#define LANELOOM_FAST_DDS 2
#include <fastdds/rtps/common/Guid.h>
#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastdds/rtps/transport/ChainingTransportDescriptor.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>

namespace eprosima::fastdds::rtps {
using namespace fastrtps::rtps;
using DiscoveryProtocol = DiscoveryProtocol_t;
}  // namespace eprosima::fastdds::rtps
namespace eprosima::fastdds::dds {
using fastrtps::Duration_t;
inline constexpr auto RETCODE_OK = fastrtps::types::ReturnCode_t::RETCODE_OK;
}  // namespace eprosima::fastdds::dds
#endif

namespace laneloom::dds {

/// The bytes that a transport is told to send.
#if LANELOOM_FAST_DDS == 3
using SentBytes = const std::vector<eprosima::fastdds::rtps::NetworkBuffer>&;
#else
using SentBytes = const eprosima::fastdds::rtps::octet*;
#endif

/// Names a type, and keeps Fast DDS from announcing a description of it: the code is generated without.
inline void announce_as(const std::string& name, eprosima::fastdds::dds::TopicDataType& type) {
#if LANELOOM_FAST_DDS == 3
  type.set_name(name);
#else
  type.setName(name.c_str());
  type.auto_fill_type_object(false);
  type.auto_fill_type_information(false);
#endif
}

/// Which samples of its list a reader takes (take_all.hpp).
#if LANELOOM_FAST_DDS == 3
inline constexpr eprosima::fastdds::dds::SampleStateMask kTakenSamples =
    eprosima::fastdds::dds::NOT_READ_SAMPLE_STATE;
#else
inline constexpr eprosima::fastdds::dds::SampleStateMask kTakenSamples =
    eprosima::fastdds::dds::ANY_SAMPLE_STATE;
#endif

inline auto& heartbeat_period(eprosima::fastdds::dds::DataWriterQos& qos) {
#if LANELOOM_FAST_DDS == 3
  return qos.reliable_writer_qos().times.heartbeat_period;
#else
  return qos.reliable_writer_qos().times.heartbeatPeriod;
#endif
}

/// Lets participants that are made after this one's end use interfaces that came up since. Fast DDS 3 looks
/// for interfaces when a program starts, and when a participant gets settings, even the same; Fast DDS 2 does
/// when a participant is made. Not for a new participant: clients of a discovery server often do not match
/// then.
inline void look_for_interfaces([[maybe_unused]] eprosima::fastdds::dds::DomainParticipant& ending) {
#if LANELOOM_FAST_DDS == 3
  ending.set_qos(ending.get_qos());
#endif
}

/// The addresses of the discovery servers that a participant asks.
inline std::vector<eprosima::fastdds::rtps::Locator_t> discovery_server_locators(
    const eprosima::fastdds::dds::DomainParticipantQos& qos) {
  const auto& servers = qos.wire_protocol().builtin.discovery_config.m_DiscoveryServers;
#if LANELOOM_FAST_DDS == 3
  return {servers.begin(), servers.end()};
#else
  std::vector<eprosima::fastdds::rtps::Locator_t> locators;
  for (const auto& server : servers)
    for (const auto& locator : server.metatrafficUnicastLocatorList) locators.push_back(locator);
  return locators;
#endif
}

}  // namespace laneloom::dds
