#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "snapshot/snapshot_file.hpp"

namespace laneloom {

/// Writes snapshots in a thread of its own: a slow disk holds up nobody. Thread-safe.
class SnapshotWriter {
 public:
  explicit SnapshotWriter(std::string file);

  /// Has it written soon, instead of one that still waits.
  void write(Snapshot snapshot);

  struct Totals {
    std::uint64_t written = 0;
    std::uint64_t failed = 0;
  };
  Totals totals() const;

 private:
  void run(const std::stop_token& stopped);
  void write_now(const Snapshot& snapshot);

  std::string file_;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::optional<Snapshot> waiting_;
  Totals totals_;
  std::jthread thread_;  ///< last: it uses all of the above
};

}  // namespace laneloom
