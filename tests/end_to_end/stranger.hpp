#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <stdexcept>
#include <vector>

#include "dds/rtps_datagrams.hpp"

namespace laneloom {

/// Someone on the network who sends what he likes to the ports of a domain.
class Stranger {
 public:
  static constexpr int kParticipants = 12;  ///< on this host, at most

  explicit Stranger(int domain) : first_port_(7400 + 250 * domain), socket_(socket(AF_INET, SOCK_DGRAM, 0)) {
    if (socket_ < 0) throw std::runtime_error("no socket for a stranger");
    const in_addr loopback{htonl(INADDR_LOOPBACK)};
    setsockopt(socket_, IPPROTO_IP, IP_MULTICAST_IF, &loopback, sizeof loopback);
  }
  ~Stranger() { close(socket_); }
  Stranger(const Stranger&) = delete;
  Stranger& operator=(const Stranger&) = delete;

  /// To discovery by multicast.
  void send_to_all(const dds::Packet& packet) const { send(packet, inet_addr("239.255.0.1"), first_port_); }
  /// To the port of discovery (even) or of the user's topics (odd) of a participant: 0 and 1 are the first's.
  void send_to(int port, const dds::Packet& packet) const {
    send(packet, htonl(INADDR_LOOPBACK), first_port_ + 10 + port);
  }
  /// Those of these ports that someone has.
  std::vector<int> ports() const {
    std::vector<int> result;
    for (int port = 0; port < 2 * kParticipants; ++port)
      if (is_taken(port)) result.push_back(port);
    return result;
  }
  void send(const dds::Packet& packet) const {
    send_to_all(packet);
    for (int port = 0; port < 2 * kParticipants; ++port) send_to(port, packet);
  }

 private:
  static sockaddr_in at(in_addr_t address, int port) {
    sockaddr_in result{};
    result.sin_family = AF_INET;
    result.sin_port = htons(static_cast<std::uint16_t>(port));
    result.sin_addr.s_addr = address;
    return result;
  }
  bool is_taken(int port) const {
    const int trial = socket(AF_INET, SOCK_DGRAM, 0);
    const sockaddr_in here = at(htonl(INADDR_LOOPBACK), first_port_ + 10 + port);
    const bool taken = bind(trial, reinterpret_cast<const sockaddr*>(&here), sizeof here) != 0;
    close(trial);
    return taken;
  }
  void send(const dds::Packet& packet, in_addr_t address, int port) const {
    const sockaddr_in to = at(address, port);
    sendto(socket_, packet.data(), packet.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof to);
  }

  int first_port_;
  int socket_;
};

}  // namespace laneloom
