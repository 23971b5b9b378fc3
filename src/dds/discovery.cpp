#include "laneloom/dds/discovery.hpp"

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>

#include <map>
#include <mutex>
#include <sstream>
#include <stdexcept>

#include "base/seconds.hpp"
#include "dds/discovery_listener.hpp"
#include "dds/guarded_transport.hpp"
#include "dds/identity_check.hpp"
#include "dds/qos.hpp"
#include "dds/writer_id.hpp"

namespace laneloom::dds {
namespace {

using namespace eprosima::fastdds::dds;
using eprosima::fastdds::rtps::DiscoveryProtocol;
using eprosima::fastdds::rtps::GUID_t;
using eprosima::fastdds::rtps::GuidPrefix_t;
using eprosima::fastdds::rtps::IPLocator;

std::optional<double> finite_seconds(const eprosima::fastdds::dds::Duration_t& duration) {
  if (duration.is_infinite()) return std::nullopt;
  return seconds(duration.to_ns());
}

Durability to_plain(DurabilityQosPolicyKind kind) {
  switch (kind) {
    case VOLATILE_DURABILITY_QOS:
      return Durability::volatile_;
    case TRANSIENT_LOCAL_DURABILITY_QOS:
      return Durability::transient_local;
    case TRANSIENT_DURABILITY_QOS:
      return Durability::transient;
    case PERSISTENT_DURABILITY_QOS:
      return Durability::persistent;
  }
  return Durability::volatile_;
}

Liveliness to_plain(LivelinessQosPolicyKind kind) {
  switch (kind) {
    case AUTOMATIC_LIVELINESS_QOS:
      return Liveliness::automatic;
    case MANUAL_BY_PARTICIPANT_LIVELINESS_QOS:
      return Liveliness::manual_by_participant;
    case MANUAL_BY_TOPIC_LIVELINESS_QOS:
      return Liveliness::manual_by_topic;
  }
  return Liveliness::automatic;
}

/// The endpoint of a writer's or a reader's announcement, without its participant.
template <class Data>
Endpoint to_plain(const Data& data, bool is_writer) {
  Endpoint endpoint;
  endpoint.is_writer = is_writer;
  endpoint.topic = data.topic_name.to_string();
  endpoint.type = data.type_name.to_string();
  endpoint.partitions = data.partition.getNames();
  endpoint.reliable = data.reliability.kind == RELIABLE_RELIABILITY_QOS;
  endpoint.durability = to_plain(data.durability.kind);
  endpoint.deadline_s = finite_seconds(data.deadline.period);
  endpoint.liveliness = to_plain(data.liveliness.kind);
  endpoint.lease_s = finite_seconds(data.liveliness.lease_duration);
  endpoint.exclusive = data.ownership.kind == EXCLUSIVE_OWNERSHIP_QOS;
  if (is_writer) endpoint.id = id_of(data.guid);
  return endpoint;
}

template <class Data>
Peer to_plain(const Data& data) {
  std::ostringstream id;
  id << data.guid.guidPrefix;
  const auto& locators = data.default_locators.unicast;
  return {id.str(), data.participant_name.to_string(),
          locators.empty() ? std::string() : IPLocator::ip_to_string(locators[0])};
}

/// The quality of service of a participant that is told of all others. A plain client of a discovery server
/// only hears of participants with which it has topics in common.
DomainParticipantQos observer_qos(const DdsConfig& config, const std::string& name) {
  auto qos = participant_qos(config, name);
  auto& protocol = qos.wire_protocol().builtin.discovery_config.discoveryProtocol;
  if (protocol == DiscoveryProtocol::CLIENT) protocol = DiscoveryProtocol::SUPER_CLIENT;
  guard_transports(qos, governance_protects_messages(config.security_directory));
  return qos;
}

}  // namespace

class Discovery::Impl : public DiscoveryListener<Discovery::Impl> {
 public:
  Impl(const DdsConfig& config, const std::string& name)
      : participant_(DomainParticipantFactory::get_instance()->create_participant(
            static_cast<DomainId_t>(config.domain), observer_qos(config, name), this, StatusMask::none())) {
    if (!participant_) throw std::runtime_error("DDS refused to make a participant");
  }
  ~Impl() override {
    participant_->set_listener(nullptr);
    DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  std::vector<Peer> participants() const {
    const std::lock_guard lock(mutex_);
    std::vector<Peer> result;
    result.reserve(peers_.size());
    for (const auto& [prefix, peer] : peers_) result.push_back(peer);
    return result;
  }

  std::vector<Endpoint> endpoints() const {
    const std::lock_guard lock(mutex_);
    std::vector<Endpoint> result;
    result.reserve(endpoints_.size());
    for (const auto& [guid, endpoint] : endpoints_) {
      const auto peer = peers_.find(guid.guidPrefix);
      if (peer == peers_.end()) continue;
      result.push_back(endpoint);
      result.back().participant = peer->second;
    }
    return result;
  }

  template <class Data>
  void note_participant(const Data& data, bool is_there) {
    const auto& prefix = data.guid.guidPrefix;
    const std::lock_guard lock(mutex_);
    if (is_there) {
      peers_.insert_or_assign(prefix, to_plain(data));
    } else {
      peers_.erase(prefix);
      std::erase_if(endpoints_, [&](const auto& entry) { return entry.first.guidPrefix == prefix; });
    }
  }
  template <class Data>
  void note_endpoint(const Data& data, bool is_writer, bool is_there) {
    const std::lock_guard lock(mutex_);
    if (is_there) {
      endpoints_.insert_or_assign(data.guid, to_plain(data, is_writer));
    } else {
      endpoints_.erase(data.guid);
    }
  }

 private:
  // Memory needs no bound: DDS itself keeps as much of every participant.
  mutable std::mutex mutex_;
  std::map<GuidPrefix_t, Peer> peers_;
  std::map<GUID_t, Endpoint> endpoints_;
  DomainParticipant* participant_;  ///< last, because it calls back from its beginning on
};

Discovery::Discovery(const DdsConfig& config, const std::string& name) {
  check_values(config);
  impl_ = std::make_unique<Impl>(config, name);
}
Discovery::Discovery(Discovery&&) noexcept = default;
Discovery& Discovery::operator=(Discovery&&) noexcept = default;
Discovery::~Discovery() = default;

std::vector<Peer> Discovery::participants() const { return impl_->participants(); }
std::vector<Endpoint> Discovery::endpoints() const { return impl_->endpoints(); }

}  // namespace laneloom::dds
