#include "snapshot/snapshot_writer.hpp"

#include <spdlog/spdlog.h>

#include <exception>
#include <utility>

namespace laneloom::snapshot {

SnapshotWriter::SnapshotWriter(std::string file)
    : file_(std::move(file)), thread_([this](const std::stop_token& stopped) { run(stopped); }) {}

void SnapshotWriter::write(Snapshot snapshot) {
  const std::lock_guard lock(mutex_);
  waiting_ = std::move(snapshot);
  changed_.notify_one();
}

SnapshotWriter::Totals SnapshotWriter::totals() const {
  const std::lock_guard lock(mutex_);
  return totals_;
}

void SnapshotWriter::run(const std::stop_token& stopped) {
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stopped, [this] { return waiting_.has_value(); })) {
    const Snapshot snapshot = *std::exchange(waiting_, std::nullopt);
    lock.unlock();
    write_now(snapshot);
    lock.lock();
  }
}

void SnapshotWriter::write_now(const Snapshot& snapshot) {
  std::string failure;
  try {
    write_snapshot(file_, snapshot);
  } catch (const std::exception& error) {
    failure = error.what();
  }
  const std::lock_guard lock(mutex_);
  // The reason is logged once. Further failures are only counted.
  if (!failure.empty() && totals_.failed++ == 0) spdlog::error("event=snapshot_failed why=\"{}\"", failure);
  if (failure.empty()) ++totals_.written;
}

}  // namespace laneloom::snapshot
