#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <stop_token>
#include <thread>
#include <vector>

namespace laneloom::bench {

/// Counts the messages in the bytes that a server sends over a WebSocket, in parts of any size.
class WebSocketCounter {
 public:
  void add(const std::uint8_t* bytes, std::size_t size);
  std::uint64_t messages() const { return messages_; }

 private:
  void begin_body();

  std::vector<std::uint8_t> header_;
  std::uint64_t left_ = 0;  ///< number of bytes of the body that are still to come
  std::uint64_t messages_ = 0;
};

/// Clients of this host's `laneloom view`, like tabs of a live view that draw nothing. They read all messages
/// in a thread of their own. Thread-safe.
class ViewReaders {
 public:
  /// Connects the clients. Throws std::runtime_error if the viewer does not accept them.
  ViewReaders(std::uint16_t port, std::size_t count);
  ~ViewReaders();
  ViewReaders(const ViewReaders&) = delete;
  ViewReaders& operator=(const ViewReaders&) = delete;

  /// Number of frames that came so far, to all clients together.
  std::uint64_t frames() const { return frames_; }

 private:
  void read(const std::stop_token& stopped);

  std::vector<int> sockets_;
  std::atomic<std::uint64_t> frames_ = 0;
  std::jthread thread_;
};

}  // namespace laneloom::bench
