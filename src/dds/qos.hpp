#pragma once

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>

#include <string>
#include <vector>

#include "laneloom/config.hpp"

/// All quality of service of laneloom.
namespace laneloom::dds {

/// The kinds of topics, by their quality of service.
enum class TopicKind {
  detections,      ///< to the service, some a second, large
  poses,           ///< to the service, many a second, small
  optional_input,  ///< to the service, some a second; the next message tells the same anew
  map,             ///< from the service, at every tick; a late reader gets the newest message
  status,          ///< from the service, now and then; a late reader gets the newest message
  view             ///< from the service to viewers; a late reader gets the next message
};

/// Throws ConfigError for a value that no participant can have. Fast DDS ends the process for some of them.
void check_values(const DdsConfig& config);
/// Throws ConfigError when the configured profile is missing or invalid, or a file of security is unreadable.
eprosima::fastdds::dds::DomainParticipantQos participant_qos(const DdsConfig& config,
                                                             const std::string& name);
eprosima::fastdds::dds::DataWriterQos writer_qos(TopicKind kind);
eprosima::fastdds::dds::DataReaderQos reader_qos(
    TopicKind kind, eprosima::fastdds::dds::ReliabilityQosPolicyKind reliability);

/// The reliabilities that the readers of a topic ask for, one reader each. The first one asks for least, so
/// that it matches every writer. `has_identity`: of the participant, for DDS-Security.
std::vector<eprosima::fastdds::dds::ReliabilityQosPolicyKind> reader_reliabilities(TopicKind kind,
                                                                                   bool has_identity);

/// Announces these bytes with a participant or an endpoint.
template <class Qos>
void set_user_data(const std::string& bytes, Qos& qos) {
  qos.user_data().data_vec({bytes.begin(), bytes.end()});
}

}  // namespace laneloom::dds
