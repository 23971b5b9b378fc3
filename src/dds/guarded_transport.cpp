#include "dds/guarded_transport.hpp"

#include <arpa/inet.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>

#include "base/clock.hpp"
#include "dds/fast_dds.hpp"

namespace laneloom::dds {
namespace {

using namespace eprosima::fastdds::rtps;
using eprosima::fastdds::dds::DomainParticipantQos;

/// Where this host reaches a port of its own.
in_addr address_of(const Locator_t& local) {
  return {IPLocator::isAny(local) ? htonl(INADDR_LOOPBACK)
                                  : inet_addr(IPLocator::toIPv4string(local).c_str())};
}

/// Hands on what is sent, but no announcement too early, and of what is received what the door lets in.
class GuardedTransport : public ChainingTransport {
 public:
  GuardedTransport(const ChainingTransportDescriptor& descriptor, std::shared_ptr<Door> door)
      : ChainingTransport(descriptor), door_(std::move(door)) {}

  TransportDescriptorInterface* get_configuration() override {
    return low_level_transport_->get_configuration();
  }
  // NOLINTNEXTLINE(readability-function-size): as Fast DDS calls it
  bool send(SenderResource* sender, SentBytes bytes, std::uint32_t size, LocatorsIterator* begin,
            LocatorsIterator* end, const std::chrono::steady_clock::time_point& timeout) override {
    const bool to_everyone = *begin != *end && IPLocator::isMulticast(**begin);
    if (to_everyone && !door_->is_open()) return true;
    return sender->send(bytes, size, begin, end, timeout);
  }
  void receive(TransportReceiverInterface* receiver, const octet* bytes, std::uint32_t size,
               const Locator_t& local, const Locator_t& remote) override {
    if (door_->lets_in({bytes, size})) {
      const auto turn = door_->turn();
      receiver->OnDataReceived(bytes, size, local, remote);
    }
    door_->probe().note_taken(IPLocator::getPhysicalPort(local));
  }
  bool OpenInputChannel(const Locator_t& local, TransportReceiverInterface* receiver,
                        std::uint32_t max_bytes) override {
    // Others of this host may have the same port for multicast.
    if (local.kind == LOCATOR_KIND_UDPv4 && !IPLocator::isMulticast(local))
      door_->probe().add_port(address_of(local), IPLocator::getPhysicalPort(local));
    return ChainingTransport::OpenInputChannel(local, receiver, max_bytes);
  }
  /// Sends to each reader at its own address. To readers that share an address of multicast, Fast DDS would
  /// send there, and some submessages to their own addresses nevertheless. It has not opened those: an
  /// assertion of its statistics then ends the process.
  void select_locators(LocatorSelector& selector) const override {
    for (auto* reader : selector.transport_starts())
      if (std::ranges::any_of(reader->unicast, [&](const auto& own) { return IsLocatorSupported(own); }))
        reader->multicast.clear();
    ChainingTransport::select_locators(selector);
  }

 private:
  std::shared_ptr<Door> door_;
};

struct GuardedDescriptor : ChainingTransportDescriptor {
  GuardedDescriptor(std::shared_ptr<TransportDescriptorInterface> guarded, std::shared_ptr<Door> its_door)
      : ChainingTransportDescriptor(std::move(guarded)), door(std::move(its_door)) {}
  TransportInterface* create_transport() const override { return new GuardedTransport(*this, door); }

  std::shared_ptr<Door> door;
};

/// Makes the transports that Fast DDS has by itself.
void name_builtin_transports(DomainParticipantQos& qos) {
  auto& transport = qos.transport();
  if (!transport.use_builtin_transports) return;
  transport.use_builtin_transports = false;
  auto udp = std::make_shared<UDPv4TransportDescriptor>();
  udp->sendBufferSize = transport.send_socket_buffer_size;
  udp->receiveBufferSize = transport.listen_socket_buffer_size;
  auto shared_memory = std::make_shared<SharedMemTransportDescriptor>();
  shared_memory->segment_size(2 * std::max(udp->sendBufferSize, udp->receiveBufferSize));
  shared_memory->max_message_size(udp->max_message_size());
  transport.user_transports.insert(transport.user_transports.begin(), {udp, shared_memory});
}

}  // namespace

std::unique_lock<std::mutex> Door::turn() {
  return guard_.wants_protection() ? std::unique_lock(turn_) : std::unique_lock<std::mutex>();
}

bool Door::lets_in(std::span<const std::uint8_t> datagram) {
  if (!is_open_) return false;
  if (probe_.is_question(datagram)) return true;
  const std::lock_guard lock(mutex_);
  const auto refusal = guard_.check(datagram, steady_now_ns());
  if (refusal) ++refused_[static_cast<std::size_t>(*refusal)];
  return !refusal;
}

Counters Door::refused() const {
  const std::lock_guard lock(mutex_);
  Counters result;
  for (std::size_t i = 0; i < refused_.size(); ++i)
    if (refused_[i] > 0) result.add("datagrams_refused_" + std::string(kDatagramRefusals[i]), refused_[i]);
  return result;
}

std::shared_ptr<Door> guard_transports(DomainParticipantQos& qos, bool wants_protection) {
  auto door = std::make_shared<Door>(wants_protection);
  name_builtin_transports(qos);
  for (auto& transport : qos.transport().user_transports)
    if (std::dynamic_pointer_cast<UDPTransportDescriptor>(transport))
      transport = std::make_shared<GuardedDescriptor>(transport, door);
  return door;
}

}  // namespace laneloom::dds
