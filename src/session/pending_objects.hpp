#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "laneloom/config.hpp"
#include "laneloom/objects.hpp"

namespace laneloom::session {

/// Holds messages of objects until a frame that is not older is fused. They are taken in the order of their
/// stamps and sessions, whatever order they came in.
class PendingObjects {
 public:
  explicit PendingObjects(const Config& config)
      : capacity_(static_cast<std::size_t>(config.sync.queue_capacity)),
        max_lead_ns_(static_cast<std::int64_t>(config.gate.max_stamp_step_s * 1e9)) {}

  /// Keeps a message that has no defect(). `newest_pose_ns` is the stamp of the newest pose, if there is one.
  /// Returns the reason to refuse the message, as a stable name. Empty: it is kept.
  std::string_view add(TrackedObjects objects, std::optional<std::int64_t> newest_pose_ns);
  /// Takes the oldest message that is not newer than `stamp_ns`. None: there is no such one.
  std::optional<TrackedObjects> take_until(std::int64_t stamp_ns);
  /// Drops the oldest messages above the capacity; returns how many.
  std::size_t drop_excess();
  /// Removes all; returns how many. Messages that are older than those taken before are believed again.
  std::size_t clear();
  std::size_t size() const { return pending_.size(); }

 private:
  using Key = std::pair<std::int64_t, std::uint64_t>;  ///< stamp and session

  std::size_t capacity_;
  std::int64_t max_lead_ns_;  ///< of a stamp, before that of the newest pose
  std::map<Key, TrackedObjects> pending_;
  std::map<std::uint64_t, std::int64_t> taken_ns_;  ///< by session, the newest stamp that was taken
};

}  // namespace laneloom::session
