#include "dds/qos.hpp"

#include <fastdds/dds/domain/DomainParticipantFactory.hpp>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <system_error>

#include "base/dds_values.hpp"
#include "dds/fast_dds.hpp"
#include "laneloom/dds/participant.hpp"
#include "laneloom/error.hpp"

namespace laneloom::dds {
namespace {

using namespace eprosima::fastdds::dds;
using eprosima::fastdds::rtps::IPLocator;
using eprosima::fastdds::rtps::SharedMemTransportDescriptor;
using eprosima::fastdds::rtps::UDPTransportDescriptor;
using eprosima::fastdds::rtps::UDPv4TransportDescriptor;

// With the kernel's default buffers, a map of 500 KB gets lost. The kernel may give less than this.
constexpr std::uint32_t kSocketBufferBytes = 4U << 20;
constexpr const char* kWithSharedMemory = "udp+shm";
constexpr std::uint32_t kSharedMemoryBytes = 16U << 20;

/// UDP that receives datagrams of any size and sends none above `max_sent_bytes`. Fast DDS asks the
/// descriptor for the largest message to send, and the transport, which has a copy of the base class alone,
/// for the size of the buffer to receive into.
struct UdpDescriptor : UDPv4TransportDescriptor {
  explicit UdpDescriptor(std::uint32_t bytes) : max_sent_bytes(bytes) {}
  std::uint32_t max_message_size() const override { return max_sent_bytes; }

  std::uint32_t max_sent_bytes;
};
// A datagram that fits into one Ethernet frame is lost alone. IP loses a larger datagram with any of its
// pieces.
constexpr std::uint32_t kSmallDatagramBytes = 1472;
// The handshakes of DDS-Security do not come through small datagrams.
constexpr std::uint32_t kLargeDatagramBytes = 65500;

// A reliable reader keeps every frame of which a part is missing, for as long as its writer may repeat that.
// A frame of 12.6 MB is within the bounds of the IDL, and a newer one is worth more than an older one.
constexpr int kUnfinishedFrames = 2;

Duration_t milliseconds(int value) {
  return {value / 1000, static_cast<std::uint32_t>(value % 1000) * 1'000'000U};
}

/// Fast DDS keeps one registry of profiles per process, and refuses a file that it has already read.
bool load_once(const std::string& file) {
  static std::mutex mutex;
  static std::set<std::string> loaded;
  const std::lock_guard lock(mutex);
  if (loaded.contains(file)) return true;
  const auto result = DomainParticipantFactory::get_instance()->load_XML_profiles_file(file);
  if (result == RETCODE_OK) loaded.insert(file);
  return result == RETCODE_OK;
}

void load_profile(const DdsConfig& config, DomainParticipantQos& qos) {
  // Fast DDS itself would only log a missing file, and go on with its defaults.
  check_profile_file(config);
  if (!load_once(config.profile_file)) {
    throw ConfigError("dds.profile_file: not valid for Fast DDS: " + config.profile_file);
  }
  const auto found =
      DomainParticipantFactory::get_instance()->get_participant_qos_from_profile(config.profile_name, qos);
  if (found != RETCODE_OK) {
    throw ConfigError("dds.profile_name: no participant \"" + config.profile_name + "\" in " +
                      config.profile_file);
  }
}

void set_transports(const DdsConfig& config, DomainParticipantQos& qos) {
  qos.transport().use_builtin_transports = false;
  qos.transport().send_socket_buffer_size = kSocketBufferBytes;
  qos.transport().listen_socket_buffer_size = kSocketBufferBytes;
  auto udp = std::make_shared<UdpDescriptor>(config.security_directory.empty() ? kSmallDatagramBytes
                                                                               : kLargeDatagramBytes);
  udp->sendBufferSize = kSocketBufferBytes;
  udp->receiveBufferSize = kSocketBufferBytes;
  qos.transport().user_transports.push_back(udp);
  if (config.transport == kWithSharedMemory) {
    auto shared_memory = std::make_shared<SharedMemTransportDescriptor>();
    shared_memory->segment_size(kSharedMemoryBytes);
    qos.transport().user_transports.push_back(shared_memory);
  }
}

/// The URI of a file. Throws if it can not be read, since Fast DDS says nothing then.
std::string readable(const std::filesystem::path& directory, const char* name) {
  const auto file = std::filesystem::absolute(directory / name);
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(file, unknown) || !std::ifstream(file)) {
    throw ConfigError("dds.security_directory: cannot read " + file.string());
  }
  return "file://" + file.string();
}

void set_security(const std::string& directory, DomainParticipantQos& qos) {
  // A Fast DDS that was built without security ignores the properties.
  if (HAVE_SECURITY == 0) throw ConfigError("dds.security_directory: this Fast DDS has no security");
  const std::string authentication = "dds.sec.auth.builtin.PKI-DH.";
  const std::string access = "dds.sec.access.builtin.Access-Permissions.";
  auto& properties = qos.properties().properties();
  // Properties of the profile are removed: of two of one name, the first would count.
  std::erase_if(properties, [](const auto& property) { return property.name().starts_with("dds.sec."); });
  properties.emplace_back("dds.sec.auth.plugin", "builtin.PKI-DH");
  properties.emplace_back(authentication + "identity_ca", readable(directory, "identity_ca.cert.pem"));
  properties.emplace_back(authentication + "identity_certificate", readable(directory, "cert.pem"));
  properties.emplace_back(authentication + "private_key", readable(directory, "key.pem"));
  properties.emplace_back("dds.sec.access.plugin", "builtin.Access-Permissions");
  properties.emplace_back(access + "permissions_ca", readable(directory, "permissions_ca.cert.pem"));
  properties.emplace_back(access + "governance", readable(directory, "governance.p7s"));
  properties.emplace_back(access + "permissions", readable(directory, "permissions.p7s"));
  properties.emplace_back("dds.sec.crypto.plugin", "builtin.AES-GCM-GMAC");
}

int depth(TopicKind kind) {
  switch (kind) {
    case TopicKind::detections:
    case TopicKind::optional_input:
      return 64;  // some seconds, so that a busy host loses none
    case TopicKind::poses:
      return 512;
    case TopicKind::map:
    case TopicKind::status:
    case TopicKind::view:
      return 1;
  }
  return 1;
}

/// Sets the quality of service that a writer and a reader of one topic have in common.
template <class Qos>
void set_common(TopicKind kind, Qos& qos) {
  qos.history().kind = KEEP_LAST_HISTORY_QOS;
  qos.history().depth = depth(kind);
  // The types are bounded but rarely full: preallocation would take their largest size for every sample.
  // Memory that is not reused would be freed too early (take_all.hpp).
  qos.endpoint().history_memory_policy = eprosima::fastdds::rtps::DYNAMIC_REUSABLE_MEMORY_MODE;
  qos.data_sharing().off();
  const bool from_service = kind == TopicKind::map || kind == TopicKind::status;
  qos.durability().kind = from_service ? TRANSIENT_LOCAL_DURABILITY_QOS : VOLATILE_DURABILITY_QOS;
  if (kind == TopicKind::map) {
    // Two periods of the slowest service.tick_rate_hz (8 Hz): two ticks are no further apart.
    qos.deadline().period = milliseconds(250);
    // Automatic liveliness would be asserted by a thread of Fast DDS while the executor hangs.
    qos.liveliness().kind = MANUAL_BY_TOPIC_LIVELINESS_QOS;
    qos.liveliness().lease_duration = milliseconds(400);
  }
}

}  // namespace

void check_values(const DdsConfig& config) {
  if (config.domain < 0 || config.domain > kLastDomain)
    throw ConfigError("dds.domain: " + std::to_string(config.domain) + " is not in 0 .. " +
                      std::to_string(kLastDomain));
  if (const std::string what = identifier_problem(config.vehicle_id); !what.empty())
    throw ConfigError("dds.vehicle_id: " + what);
  if (config.transport != "udp" && config.transport != kWithSharedMemory)
    throw ConfigError("dds.transport: \"" + config.transport + "\" is none of udp|" + kWithSharedMemory);
}

DomainParticipantQos participant_qos(const DdsConfig& config, const std::string& name) {
  DomainParticipantQos qos = PARTICIPANT_QOS_DEFAULT;
  if (config.profile_file.empty()) {
    set_transports(config, qos);
    // The lease is far longer than a process hangs: after a lease that only one side saw end, Fast DDS 2.9
    // does not match the two again. The death of a writer is noticed much sooner, by missing messages.
    auto& discovery = qos.wire_protocol().builtin.discovery_config;
    discovery.leaseDuration = milliseconds(20'000);
    discovery.leaseDuration_announcementperiod = milliseconds(500);
    // A service that was killed is heard again some hundredths of a second after its start.
    discovery.initial_announcements.count = 20;
    discovery.initial_announcements.period = milliseconds(25);
  } else {
    load_profile(config, qos);
  }
  if (!config.security_directory.empty()) set_security(config.security_directory, qos);
  qos.name(name);
  return qos;
}

std::uint32_t largest_datagram(const DdsConfig& config) {
  const DomainParticipantQos qos = participant_qos(config, "");
  std::uint32_t largest = kLargeDatagramBytes;
  for (const auto& transport : qos.transport().user_transports)
    if (const auto* udp = dynamic_cast<const UDPTransportDescriptor*>(transport.get()))
      largest = std::min(largest, udp->maxMessageSize);
  return largest;
}

std::vector<std::string> discovery_servers(const DdsConfig& config) {
  const DomainParticipantQos qos = participant_qos(config, "");
  std::vector<std::string> result;
  for (const auto& locator : discovery_server_locators(qos))
    result.push_back(IPLocator::ip_to_string(locator) + ":" +
                     std::to_string(IPLocator::getPhysicalPort(locator)));
  return result;
}

DataWriterQos writer_qos(TopicKind kind) {
  DataWriterQos qos = DATAWRITER_QOS_DEFAULT;
  set_common(kind, qos);
  qos.reliability().kind = RELIABLE_RELIABILITY_QOS;
  qos.reliability().max_blocking_time = milliseconds(50);
  // A lost sample is repaired after this time; the default is 3 s.
  heartbeat_period(qos) = milliseconds(20);
  qos.publish_mode().kind = SYNCHRONOUS_PUBLISH_MODE;
  return qos;
}

DataReaderQos reader_qos(TopicKind kind, ReliabilityQosPolicyKind reliability) {
  DataReaderQos qos = DATAREADER_QOS_DEFAULT;
  set_common(kind, qos);
  qos.reliability().kind = reliability;
  if (kind == TopicKind::detections && reliability == RELIABLE_RELIABILITY_QOS)
    qos.history().depth = kUnfinishedFrames;
  return qos;
}

std::vector<ReliabilityQosPolicyKind> reader_reliabilities(TopicKind kind, bool has_identity) {
  switch (kind) {
    case TopicKind::detections:
      // Sensors often write best effort, which a reliable reader does not match. From a reliable writer, the
      // best-effort reader has a frame at once, and the reliable one has frames that had to be repaired: a
      // large frame seldom comes through whole. With identities, Fast DDS 3.1 loses frames for two readers of
      // one participant as soon as others read them, too.
      if (LANELOOM_FAST_DDS == 3 && has_identity) return {BEST_EFFORT_RELIABILITY_QOS};
      return {BEST_EFFORT_RELIABILITY_QOS, RELIABLE_RELIABILITY_QOS};
    case TopicKind::optional_input:  // a message less costs little: the next one tells the same
    case TopicKind::poses:
      return {BEST_EFFORT_RELIABILITY_QOS};  // a pose that has to be sent again comes after the next one
    case TopicKind::map:
    case TopicKind::status:
    case TopicKind::view:
      break;
  }
  return {RELIABLE_RELIABILITY_QOS};
}

}  // namespace laneloom::dds
