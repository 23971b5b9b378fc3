#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "snapshot/snapshot_file.hpp"

namespace laneloom::snapshot {

/// Writes snapshots in a thread of its own, so that a slow disk holds up no caller. Thread-safe.
class SnapshotWriter {
 public:
  explicit SnapshotWriter(std::string file);

  /// Hands over a snapshot to be written soon. It replaces one that still waits.
  void write(Snapshot snapshot);

  /// Counts since the start.
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
  std::jthread thread_;  ///< last, because it uses all of the above
};

}  // namespace laneloom::snapshot
