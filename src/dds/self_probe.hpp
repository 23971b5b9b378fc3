#pragma once

#include <netinet/in.h>

#include <cstdint>
#include <map>
#include <mutex>
#include <span>
#include <vector>

#include "laneloom/dds/participant.hpp"

namespace laneloom::dds {

/// Finds out whether a participant still takes what its ports receive. It sends datagrams to them that lead
/// through the locks of discovery, and notes whether the thread of each port comes back from Fast DDS.
/// Thread-safe; no call waits.
class SelfProbe {
 public:
  SelfProbe();
  ~SelfProbe();
  SelfProbe(const SelfProbe&) = delete;
  SelfProbe& operator=(const SelfProbe&) = delete;

  /// A port of the participant's own, in the host's order of bytes.
  void add_port(in_addr address, std::uint16_t port);
  /// Fast DDS has taken a datagram that came to this port.
  void note_taken(std::uint16_t port);
  /// Sends a datagram to each port. A port that has never taken one does not count: there may be no way to
  /// it.
  SelfCheck ask();
  /// Whether these are the bytes of this probe's datagrams. They hold a random number and stay on this host,
  /// so that nobody else can send them.
  bool is_question(std::span<const std::uint8_t> datagram) const;

 private:
  struct Port {
    sockaddr_in address{};
    bool has_taken = false;
    int unanswered = 0;
  };
  bool send_to(sockaddr_in address);

  std::vector<std::uint8_t> question_;
  std::mutex mutex_;
  std::map<std::uint16_t, Port> ports_;
  int socket_;
};

}  // namespace laneloom::dds
