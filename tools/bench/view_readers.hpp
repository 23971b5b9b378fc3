#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <stop_token>
#include <thread>
#include <vector>

namespace laneloom {

/// Counts the messages in a stream of a WebSocket's bytes from a server, in parts of any size.
class WebSocketCounter {
 public:
  void add(const std::uint8_t* bytes, std::size_t size);
  std::uint64_t messages() const { return messages_; }

 private:
  void begin_body();

  std::vector<std::uint8_t> header_;
  std::uint64_t left_ = 0;  ///< bytes of the body that are to come
  std::uint64_t messages_ = 0;
};

/// Tabs of a live view that draw nothing: clients of this host's `laneloom view` that read, in a thread of
/// their own, all that they are sent. Thread-safe.
class ViewReaders {
 public:
  /// Throws std::runtime_error where the viewer does not take them.
  ViewReaders(std::uint16_t port, std::size_t count);
  ~ViewReaders();
  ViewReaders(const ViewReaders&) = delete;
  ViewReaders& operator=(const ViewReaders&) = delete;

  /// That came so far, to all of them.
  std::uint64_t frames() const { return frames_; }

 private:
  void read(const std::stop_token& stopped);

  std::vector<int> sockets_;
  std::atomic<std::uint64_t> frames_ = 0;
  std::jthread thread_;
};

}  // namespace laneloom
