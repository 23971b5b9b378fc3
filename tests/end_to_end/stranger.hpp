#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <stdexcept>

#include "dds/rtps_datagrams.hpp"

namespace laneloom {

/// Someone on the network who sends what he likes to all ports of a domain.
class Stranger {
 public:
  explicit Stranger(int domain) : first_port_(7400 + 250 * domain), socket_(socket(AF_INET, SOCK_DGRAM, 0)) {
    if (socket_ < 0) throw std::runtime_error("no socket for a stranger");
    const in_addr loopback{htonl(INADDR_LOOPBACK)};
    setsockopt(socket_, IPPROTO_IP, IP_MULTICAST_IF, &loopback, sizeof loopback);
  }
  ~Stranger() { close(socket_); }
  Stranger(const Stranger&) = delete;
  Stranger& operator=(const Stranger&) = delete;

  /// To discovery, by multicast and by unicast, and to the user's topics.
  void send(const dds::Packet& packet) const {
    send(packet, inet_addr("239.255.0.1"), first_port_);
    for (int port = 10; port < 10 + 2 * kParticipants; ++port)
      send(packet, htonl(INADDR_LOOPBACK), first_port_ + port);
  }

 private:
  static constexpr int kParticipants = 12;  ///< on this host, at most

  void send(const dds::Packet& packet, in_addr_t address, int port) const {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(port));
    to.sin_addr.s_addr = address;
    sendto(socket_, packet.data(), packet.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof to);
  }

  int first_port_;
  int socket_;
};

}  // namespace laneloom
