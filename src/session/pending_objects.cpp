#include "session/pending_objects.hpp"

#include <algorithm>

namespace laneloom::session {
namespace {

constexpr std::size_t kTrackersRemembered = 8;

}  // namespace

std::string_view PendingObjects::add(TrackedObjects objects, std::optional<std::int64_t> newest_pose_ns) {
  const Key key(objects.stamp_ns, objects.session_id);
  if (!newest_pose_ns) return "unsynchronised";
  // A stamp that is far ahead, by another clock, would keep its place until the queue is full.
  if (objects.stamp_ns - *newest_pose_ns > max_lead_ns_) return "outlier";
  if (const auto taken = taken_ns_.find(objects.session_id); taken != taken_ns_.end()) {
    if (objects.stamp_ns == taken->second) return "repeated";
    if (objects.stamp_ns < taken->second) return "late";
  }
  return pending_.emplace(key, std::move(objects)).second ? std::string_view() : "repeated";
}

std::optional<TrackedObjects> PendingObjects::take_until(std::int64_t stamp_ns) {
  if (pending_.empty() || pending_.begin()->first.first > stamp_ns) return std::nullopt;
  TrackedObjects oldest = std::move(pending_.begin()->second);
  pending_.erase(pending_.begin());
  taken_ns_[oldest.session_id] = oldest.stamp_ns;
  if (taken_ns_.size() > kTrackersRemembered)
    taken_ns_.erase(std::ranges::min_element(taken_ns_, {}, [](const auto& entry) { return entry.second; }));
  return oldest;
}

std::size_t PendingObjects::drop_excess() {
  std::size_t dropped = 0;
  for (; pending_.size() > capacity_; ++dropped) pending_.erase(pending_.begin());
  return dropped;
}

std::size_t PendingObjects::clear() {
  const std::size_t count = pending_.size();
  pending_.clear();
  taken_ns_.clear();
  return count;
}

}  // namespace laneloom::session
