#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "dds/rtps_datagrams.hpp"

namespace laneloom {

/// Hears who announces himself in a domain, as anyone on the network can.
class Eavesdropper {
 public:
  /// Tells the ports of the participants whose announcements have this name in them.
  explicit Eavesdropper(int domain, std::string_view name = "")
      : first_port_(7400 + 250 * domain),
        name_(name),
        socket_(socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK, 0)) {
    const int yes = 1;
    setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    sockaddr_in here{};
    here.sin_family = AF_INET;
    here.sin_port = htons(static_cast<std::uint16_t>(first_port_));
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
      note_ports(std::span(bytes).first(static_cast<std::size_t>(size)));
      if (std::ranges::find(heard_, prefix) == heard_.end()) heard_.push_back(prefix);
      if (heard_.size() > kMostKept) heard_.erase(heard_.begin());
    }
    return heard_;
  }
  /// The ports of those who were named when they were heard, as Stranger::send_to() takes them.
  std::vector<int> ports() const {
    std::vector<int> result;
    for (const auto& [port, is_named] : ports_)
      if (is_named) result.push_back(port - first_port_ - 10);
    return result;
  }

 private:
  static constexpr std::size_t kMostKept = 8;

  /// A port is of who announced it last.
  void note_ports(std::span<const std::uint8_t> announcement) {
    const auto end = announcement.end();
    const bool is_named = std::search(announcement.begin(), end, name_.begin(), name_.end()) != end;
    // Parameters of announcements: where the participant listens, by UDP over IPv4, to others' topics (0x31)
    // and announcements (0x32). The port is behind.
    for (const std::uint8_t whose : std::array<std::uint8_t, 2>{0x31, 0x32}) {
      const std::array<std::uint8_t, 8> address{whose, 0, 24, 0, 1, 0, 0, 0};
      const auto found = std::search(announcement.begin(), end, address.begin(), address.end());
      if (end - found < static_cast<std::ptrdiff_t>(address.size()) + 2) continue;
      const auto port = found + address.size();
      ports_[port[0] | port[1] << 8] = is_named;
    }
  }

  int first_port_;
  std::string_view name_;
  int socket_;
  std::vector<dds::Prefix> heard_;
  std::map<int, bool> ports_;  ///< whether who has it is named
};

}  // namespace laneloom
