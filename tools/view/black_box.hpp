#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "laneloom/config.hpp"
#include "recording/recording.hpp"
#include "view/frame_store.hpp"
#include "view/packed.hpp"

namespace laneloom::view {

/// Keeps the messages of the last seconds, to be saved as a recording. Thread-safe: one thread may add
/// messages while another saves.
class BlackBox {
 public:
  explicit BlackBox(const DdsConfig& dds, const StoreLimits& limits);

  /// Takes a message that arrived at `time_ns` (system clock).
  void add(const recording::AnyMessage& message, std::int64_t time_ns);

  /// A recording (MCAP) of the messages, with the service's configuration if its status was heard. Throws
  /// std::runtime_error if no temporary file can be written.
  std::string mcap() const;

 private:
  struct Entry {
    std::int64_t log_time_ns = 0;
    std::size_t topic = 0;
    std::size_t end = 0;  ///< among the bytes of its group
  };
  struct Group {
    std::vector<Entry> entries;
    Packed messages;
  };

  std::string map_frame_id_;
  StoreLimits limits_;
  mutable std::mutex mutex_;
  std::deque<Group> groups_;
  std::size_t bytes_ = 0;  ///< of the groups
  // The messages that are in no group yet:
  std::vector<Entry> open_entries_;
  std::string open_;
  std::vector<std::uint8_t> cdr_;
  std::int64_t log_time_ns_ = 0;
  std::optional<ServiceStatus> status_;  ///< the newest
};

}  // namespace laneloom::view
