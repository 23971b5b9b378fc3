#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

namespace laneloom {

/// A client of a server on this host that sends whatever bytes it is told.
class Client {
 public:
  explicit Client(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in server{};
    server.sin_family = AF_INET;
    server.sin_port = htons(port);
    server.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (connect(socket_, reinterpret_cast<const sockaddr*>(&server), sizeof server) != 0)
      throw std::system_error(errno, std::generic_category(), "connect");
  }
  Client(Client&& other) noexcept : socket_(std::exchange(other.socket_, -1)) {}
  Client& operator=(Client&&) = delete;
  ~Client() {
    if (socket_ >= 0) close(socket_);
  }

  void send(const std::string& bytes) const { ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL); }

  /// The bytes that come until `end` is among them. Throws std::runtime_error if it does not come in time.
  std::string receive_until(const std::string& end) {
    std::string bytes;
    while (bytes.find(end) == std::string::npos) {
      if (!receive(bytes)) throw std::runtime_error("the server ended with: " + bytes.substr(0, 500));
    }
    return bytes;
  }

  /// The bytes that come until the server ends the connection.
  std::string receive_all() {
    std::string bytes;
    while (receive(bytes)) {
    }
    return bytes;
  }

 private:
  bool receive(std::string& to) const {
    constexpr int kPatience_ms = 20'000;
    pollfd ready{socket_, POLLIN, 0};
    if (poll(&ready, 1, kPatience_ms) != 1)
      throw std::runtime_error("nothing came after: " + to.substr(0, 500));
    std::array<char, 65536> part{};
    const ssize_t size = recv(socket_, part.data(), part.size(), 0);
    if (size <= 0) return false;
    to.append(part.data(), static_cast<std::size_t>(size));
    return true;
  }

  int socket_;
};

}  // namespace laneloom
