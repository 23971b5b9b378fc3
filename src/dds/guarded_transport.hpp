#pragma once

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>

#include "dds/rtps_guard.hpp"
#include "dds/self_probe.hpp"
#include "laneloom/counters.hpp"

namespace laneloom::dds {

/// The guard of one participant, for all its sockets, with what it has refused. Thread-safe.
class Door {
 public:
  explicit Door(bool wants_protection) : guard_(wants_protection) {}
  /// Whether the door is open, and the guard lets it in, or it is a question of the probe: that comes in the
  /// clear.
  bool lets_in(std::span<const std::uint8_t> datagram);
  /// To be held while a datagram is taken that came in. Fast DDS takes those of each port in a thread of its
  /// own. While it begins a handshake in one of them, it drops the other side's first message in another one,
  /// and then waits for a second. So, with identities, datagrams are taken one at a time.
  std::unique_lock<std::mutex> turn();
  /// datagrams_refused_<reason>, for the reasons that occurred.
  Counters refused() const;
  SelfProbe& probe() { return probe_; }
  /// Until open(), the participant is not announced to all, and hears nothing. Whoever hears the first
  /// announcement answers at once, and not again for a while: the participant has to listen by then. If it
  /// heard others before, it would begin handshakes with participants that do not know it yet.
  void shut() { is_open_ = false; }
  void open() { is_open_ = true; }
  bool is_open() const { return is_open_; }

 private:
  std::mutex turn_;
  SelfProbe probe_;
  mutable std::mutex mutex_;
  RtpsGuard guard_;
  std::array<std::uint64_t, kDatagramRefusals.size()> refused_{};
  std::atomic<bool> is_open_ = true;
};

/// Puts a guard in front of each UDP transport, also in front of that which Fast DDS would make by itself.
/// TCP and shared memory have none.
/// `wants_protection`: as RtpsGuard has it.
std::shared_ptr<Door> guard_transports(eprosima::fastdds::dds::DomainParticipantQos& qos,
                                       bool wants_protection);

}  // namespace laneloom::dds
