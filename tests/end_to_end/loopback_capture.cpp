#include "loopback_capture.hpp"

#include <arpa/inet.h>
#include <linux/if_ether.h>
#include <linux/if_packet.h>
#include <net/if.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <cerrno>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace laneloom {

LoopbackCapture::LoopbackCapture(std::string marker) : marker_(std::move(marker)) {
  socket_ = socket(AF_PACKET, SOCK_RAW | SOCK_CLOEXEC, htons(ETH_P_ALL));
  if (socket_ < 0) throw std::system_error(errno, std::generic_category(), "a packet socket");
  sockaddr_ll loopback{};
  loopback.sll_family = AF_PACKET;
  loopback.sll_protocol = htons(ETH_P_ALL);
  loopback.sll_ifindex = static_cast<int>(if_nametoindex("lo"));
  if (bind(socket_, reinterpret_cast<const sockaddr*>(&loopback), sizeof loopback) != 0) {
    const int reason = errno;
    close(socket_);
    throw std::system_error(reason, std::generic_category(), "packets of the loopback device");
  }
  constexpr timeval kPatience{.tv_sec = 0, .tv_usec = 100'000};
  setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &kPatience, sizeof kPatience);
  thread_ = std::jthread([this](const std::stop_token& stopped) { run(stopped); });
}

LoopbackCapture::~LoopbackCapture() {
  thread_.request_stop();
  thread_.join();
  close(socket_);
}

void LoopbackCapture::run(const std::stop_token& stopped) {
  std::vector<char> buffer(1U << 17U);
  while (!stopped.stop_requested()) {
    const auto size = recv(socket_, buffer.data(), buffer.size(), 0);
    if (size <= 0) continue;
    const std::string_view packet(buffer.data(), static_cast<std::size_t>(size));
    if (packet.find("RTPS") == std::string_view::npos) continue;
    ++packets_;
    if (packet.find(marker_) != std::string_view::npos) marker_seen_ = true;
  }
}

}  // namespace laneloom
