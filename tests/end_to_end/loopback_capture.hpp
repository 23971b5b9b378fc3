#pragma once

#include <atomic>
#include <string>
#include <thread>

namespace laneloom {

/// Looks at every packet between the processes of this host.
class LoopbackCapture {
 public:
  /// What to look for. Throws std::system_error when this user may not see packets.
  explicit LoopbackCapture(std::string marker);
  ~LoopbackCapture();
  LoopbackCapture(const LoopbackCapture&) = delete;
  LoopbackCapture& operator=(const LoopbackCapture&) = delete;

  bool marker_seen() const { return marker_seen_; }
  /// Of DDS.
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
