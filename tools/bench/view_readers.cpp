#include "bench/view_readers.hpp"

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <string_view>

namespace laneloom::bench {
namespace {

constexpr std::string_view kRequest =
    "GET /live HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
    "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: bGFuZWxvb20gYmVuY2ggIQ==\r\n\r\n";

int connect_to(std::uint16_t port) {
  sockaddr_in server{};
  server.sin_family = AF_INET;
  server.sin_port = htons(port);
  server.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (connect(socket, reinterpret_cast<const sockaddr*>(&server), sizeof server) != 0 ||
      send(socket, kRequest.data(), kRequest.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(kRequest.size())) {
    close(socket);
    throw std::runtime_error("the viewer cannot be reached");
  }
  return socket;
}

/// Reads an answer of HTTP byte by byte, so that no byte of the stream behind it is taken.
void read_answer(int socket) {
  std::string answer;
  char byte = 0;
  while (!answer.ends_with("\r\n\r\n") && recv(socket, &byte, 1, 0) == 1) answer += byte;
  if (!answer.starts_with("HTTP/1.1 101")) throw std::runtime_error("the viewer answers: " + answer);
}

}  // namespace

void WebSocketCounter::add(const std::uint8_t* bytes, std::size_t size) {
  while (size > 0) {
    if (left_ > 0) {
      const auto skipped = static_cast<std::size_t>(std::min<std::uint64_t>(left_, size));
      left_ -= skipped;
      bytes += skipped;
      size -= skipped;
    } else {
      header_.push_back(*bytes++);
      --size;
      begin_body();
    }
  }
}

/// Begins the body if the header is whole.
void WebSocketCounter::begin_body() {
  constexpr unsigned kLast = 0x80, kControl = 0x08, kTwoBytes = 126, kEightBytes = 127;
  if (header_.size() < 2) return;
  const std::size_t more = header_[1] == kEightBytes ? 8 : header_[1] == kTwoBytes ? 2 : 0;
  if (header_.size() < 2 + more) return;
  left_ = more == 0 ? header_[1] : 0;
  for (std::size_t i = 0; i < more; ++i) left_ = (left_ << 8U) | header_[2 + i];
  if ((header_[0] & kLast) != 0 && (header_[0] & kControl) == 0) ++messages_;
  header_.clear();
}

ViewReaders::ViewReaders(std::uint16_t port, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    sockets_.push_back(connect_to(port));
    read_answer(sockets_.back());
  }
  thread_ = std::jthread([this](const std::stop_token& stopped) { read(stopped); });
}

ViewReaders::~ViewReaders() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
  for (const int socket : sockets_) close(socket);
}

void ViewReaders::read(const std::stop_token& stopped) {
  constexpr int kLook_ms = 100;
  std::vector<WebSocketCounter> counters(sockets_.size());
  std::vector<pollfd> ready;
  for (const int socket : sockets_) ready.push_back({socket, POLLIN, 0});
  std::vector<std::uint8_t> part(1U << 16U);
  while (!stopped.stop_requested()) {
    poll(ready.data(), ready.size(), kLook_ms);
    for (std::size_t i = 0; i < ready.size(); ++i) {
      if (ready[i].revents == 0) continue;
      const ssize_t size = recv(ready[i].fd, part.data(), part.size(), 0);
      if (size <= 0) ready[i].fd = -1;  // the viewer has ended; poll() passes over it
      const std::uint64_t before = counters[i].messages();
      if (size > 0) counters[i].add(part.data(), static_cast<std::size_t>(size));
      frames_ += counters[i].messages() - before;
    }
  }
}

}  // namespace laneloom::bench
