#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace laneloom::view {

/// The frames of a recording, compressed, and the summary of each. Thread-safe: one thread may add frames
/// while another reads.
class FrameStore {
 public:
  /// `summary` is a JSON object.
  void add(std::string summary, std::string_view frame);
  /// Notes that no more frames will be added. `error` says why frames are missing; empty: none are.
  void finish(const std::string& error = "");

  std::size_t size() const;
  /// The reason why there will never be a frame to show. Empty: there is one, or there may still be.
  std::string failure() const;
  /// The frame of a number. None: there is no such frame.
  std::optional<std::string> frame(std::size_t number) const;
  /// The summaries from a number on, as many as fit into one answer: {"complete": true, "error": "",
  /// "frames": [summary, …]}. It is complete if it holds the last one.
  std::string summaries(std::size_t from) const;

 private:
  struct Compressed {
    std::vector<std::uint8_t> bytes;
    std::size_t size = 0;  ///< before compression
  };

  mutable std::mutex mutex_;
  std::vector<Compressed> frames_;
  std::vector<std::string> summaries_;
  bool finished_ = false;
  std::string error_;
};

}  // namespace laneloom::view
