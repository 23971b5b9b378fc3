#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "base/seconds.hpp"
#include "laneloom/config.hpp"

namespace laneloom::session {

/// Holds messages of type T (TrackedObjects, NextTurn) until a frame that is not older is fused. They are
/// taken in the order of their stamps and sessions, whatever order they came in.
template <class T>
class PendingMessages {
 public:
  explicit PendingMessages(const Config& config)
      : capacity_(static_cast<std::size_t>(config.sync.queue_capacity)),
        max_lead_ns_(nanoseconds(config.gate.max_stamp_step_s)) {}

  /// Keeps a message that has no defect(). `newest_pose_ns` is the stamp of the newest pose, if there is one.
  /// Returns the reason to refuse the message, as a stable name. Empty: it is kept.
  std::string_view add(T message, std::optional<std::int64_t> newest_pose_ns) {
    const Key key(message.stamp_ns, message.session_id);
    if (!newest_pose_ns) return "unsynchronised";
    // A stamp that is far ahead, by another clock, would keep its place until the queue is full.
    if (message.stamp_ns - *newest_pose_ns > max_lead_ns_) return "outlier";
    if (const auto taken = taken_ns_.find(message.session_id); taken != taken_ns_.end()) {
      if (message.stamp_ns == taken->second) return "repeated";
      if (message.stamp_ns < taken->second) return "late";
    }
    return pending_.emplace(key, std::move(message)).second ? std::string_view() : "repeated";
  }

  /// Takes the oldest message that is not newer than `stamp_ns`. None: there is no such one.
  std::optional<T> take_until(std::int64_t stamp_ns) {
    if (pending_.empty() || pending_.begin()->first.first > stamp_ns) return std::nullopt;
    T oldest = std::move(pending_.begin()->second);
    pending_.erase(pending_.begin());
    taken_ns_[oldest.session_id] = oldest.stamp_ns;
    if (taken_ns_.size() > kSessionsRemembered)
      taken_ns_.erase(
          std::ranges::min_element(taken_ns_, {}, [](const auto& entry) { return entry.second; }));
    return oldest;
  }

  /// Drops the oldest messages above the capacity; returns how many.
  std::size_t drop_excess() {
    std::size_t dropped = 0;
    for (; pending_.size() > capacity_; ++dropped) pending_.erase(pending_.begin());
    return dropped;
  }

  /// Removes all; returns how many. Messages that are older than those taken before are believed again.
  std::size_t clear() {
    const std::size_t count = pending_.size();
    pending_.clear();
    taken_ns_.clear();
    return count;
  }

  std::size_t size() const { return pending_.size(); }

 private:
  using Key = std::pair<std::int64_t, std::uint64_t>;  ///< stamp and session
  static constexpr std::size_t kSessionsRemembered = 8;

  std::size_t capacity_;
  std::int64_t max_lead_ns_;  ///< of a stamp, before that of the newest pose
  std::map<Key, T> pending_;
  std::map<std::uint64_t, std::int64_t> taken_ns_;  ///< by session, the newest stamp that was taken
};

}  // namespace laneloom::session
