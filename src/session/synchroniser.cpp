#include "session/synchroniser.hpp"

#include <algorithm>
#include <utility>

#include "base/seconds.hpp"

namespace laneloom::session {

std::optional<SynchronisedFrame> Synchroniser::next(std::size_t& refused) {
  while (!pending_.empty()) {
    const auto oldest = pending_.begin();
    SynchronisedFrame result;
    const auto answer = poses_.at(oldest->first, result.T_map_body);
    // The frames behind it are newer, and have to wait as well.
    if (answer == PoseBuffer::Answer::not_yet) return std::nullopt;
    result.pending = std::move(oldest->second);
    pending_.erase(oldest);
    if (answer == PoseBuffer::Answer::found) return result;
    ++refused;
  }
  return std::nullopt;
}

std::size_t Synchroniser::ready() const {
  Eigen::Isometry3d unused;
  return static_cast<std::size_t>(std::ranges::count_if(pending_, [&](const auto& entry) {
    return poses_.at(entry.first, unused) == PoseBuffer::Answer::found;
  }));
}

std::size_t Synchroniser::expire(std::int64_t now_ns) {
  const auto max_wait_ns = nanoseconds(config_.max_wait_s);
  Eigen::Isometry3d unused;
  return std::erase_if(pending_, [&](const auto& entry) {
    return now_ns - entry.second.arrival_ns > max_wait_ns &&
           poses_.at(entry.first, unused) == PoseBuffer::Answer::not_yet;
  });
}

std::size_t Synchroniser::drop_excess() {
  std::size_t dropped = 0;
  for (; pending_.size() > static_cast<std::size_t>(config_.queue_capacity); ++dropped) {
    const std::string_view most = source_with_most();
    pending_.erase(
        std::ranges::find_if(pending_, [&](const auto& entry) { return entry.second.frame.source == most; }));
  }
  return dropped;
}

std::string_view Synchroniser::source_with_most() const {
  std::map<std::string_view, std::size_t> counts;
  for (const auto& [stamp_ns, pending] : pending_) ++counts[pending.frame.source];
  return std::ranges::max_element(counts, {}, [](const auto& count) { return count.second; })->first;
}

std::size_t Synchroniser::clear_frames() {
  const auto count = pending_.size();
  pending_.clear();
  return count;
}

}  // namespace laneloom::session
