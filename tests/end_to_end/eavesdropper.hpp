#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "dds/rtps_datagrams.hpp"

namespace laneloom {

/// Hears who announces himself in a domain, as anyone on the network can.
class Eavesdropper {
 public:
  explicit Eavesdropper(int domain) : socket_(socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK, 0)) {
    const int yes = 1;
    setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    sockaddr_in here{};
    here.sin_family = AF_INET;
    here.sin_port = htons(static_cast<std::uint16_t>(7400 + 250 * domain));
    if (bind(socket_, reinterpret_cast<const sockaddr*>(&here), sizeof here) != 0)
      throw std::runtime_error("an eavesdropper cannot hear the domain");
    for (const in_addr_t interface : {INADDR_ANY, INADDR_LOOPBACK}) {
      const ip_mreq group{.imr_multiaddr = {inet_addr("239.255.0.1")}, .imr_interface = {htonl(interface)}};
      setsockopt(socket_, IPPROTO_IP, IP_ADD_MEMBERSHIP, &group, sizeof group);
    }
  }
  ~Eavesdropper() { close(socket_); }
  Eavesdropper(const Eavesdropper&) = delete;
  Eavesdropper& operator=(const Eavesdropper&) = delete;

  /// The participants that were heard so far, of which the newest ones are kept.
  const std::vector<dds::Prefix>& participants() {
    constexpr std::ptrdiff_t kPrefixAt = 8;
    std::array<std::uint8_t, 65536> bytes{};
    for (ssize_t size = 0; (size = recv(socket_, bytes.data(), bytes.size(), 0)) >= 0;) {
      dds::Prefix prefix{};
      if (size < kPrefixAt + static_cast<ssize_t>(prefix.size())) continue;
      std::copy_n(bytes.begin() + kPrefixAt, prefix.size(), prefix.begin());
      if (std::ranges::find(heard_, prefix) == heard_.end()) heard_.push_back(prefix);
      if (heard_.size() > kMostKept) heard_.erase(heard_.begin());
    }
    return heard_;
  }

 private:
  static constexpr std::size_t kMostKept = 8;

  int socket_;
  std::vector<dds::Prefix> heard_;
};

}  // namespace laneloom
