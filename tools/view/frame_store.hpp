#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "view/packed.hpp"

namespace laneloom::view {

/// How much a store keeps. What exceeds a limit is dropped, the oldest first.
struct StoreLimits {
  double span_s = std::numeric_limits<double>::infinity();
  std::size_t bytes = std::numeric_limits<std::size_t>::max();  ///< of compressed frames
};

/// The frames of a recording, or the last ones of a live view, compressed, and the summary of each.
/// Thread-safe: one thread may add frames while another reads.
class FrameStore {
 public:
  explicit FrameStore(const StoreLimits& limits = {}) : limits_(limits) {}

  /// `summary` is a JSON object; `time_ns` is the frame's time, which is what limits count.
  void add(std::int64_t time_ns, std::string summary, std::string_view frame);
  /// Notes that no more frames will be added. `error` says why frames are missing; empty: none are.
  void finish(const std::string& error = "");

  /// Number of frames that were added.
  std::size_t size() const;
  /// The reason why there will never be a frame to show. Empty: there is one, or there may still be.
  std::string failure() const;
  /// The frame of a number, which counts from 0. None: there is no such frame, or no longer.
  std::optional<std::string> frame(std::size_t number) const;
  /// The summaries from a number on, or from the first that is kept, as many as fit into one answer:
  /// {"complete": true, "error": "", "frames": [summary, …]}. It is complete if it holds the last one.
  std::string summaries(std::size_t from) const;

 private:
  /// Some frames one after the other. Frames are much alike, so that several together compress better.
  struct Group {
    std::int64_t time_ns = 0;  ///< of the first one
    std::size_t first = 0;     ///< number of the first one
    std::vector<std::size_t> ends;
    Packed frames;
  };

  void close_group();

  StoreLimits limits_;
  mutable std::mutex mutex_;
  std::deque<Group> groups_;
  std::size_t bytes_ = 0;  ///< of the groups
  // The frames that are in no group yet:
  std::int64_t open_time_ns_ = 0;
  std::string open_;
  std::vector<std::size_t> open_ends_;
  std::deque<std::string> summaries_;  ///< of the frames that are kept
  std::size_t size_ = 0;
  bool finished_ = false;
  std::string error_;
};

}  // namespace laneloom::view
