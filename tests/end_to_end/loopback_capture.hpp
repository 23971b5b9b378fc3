#pragma once

#include <atomic>
#include <string>
#include <thread>

namespace laneloom {

/// Looks at every packet between the processes of this host.
class LoopbackCapture {
 public:
  /// Looks for `marker`. Throws std::system_error when this user may not see packets.
  explicit LoopbackCapture(std::string marker);
  ~LoopbackCapture();
  LoopbackCapture(const LoopbackCapture&) = delete;
  LoopbackCapture& operator=(const LoopbackCapture&) = delete;

  bool marker_seen() const { return marker_seen_; }
  /// The number of DDS's packets.
  int packets() const { return packets_; }

 private:
  void run(const std::stop_token& stopped);

  std::string marker_;
  int socket_ = -1;
  std::atomic<bool> marker_seen_ = false;
  std::atomic<int> packets_ = 0;
  std::jthread thread_;
};

}  // namespace laneloom
