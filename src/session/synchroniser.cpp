#include "session/synchroniser.hpp"

#include <utility>

namespace laneloom {

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

std::size_t Synchroniser::expire(std::int64_t now_ns) {
  const auto max_wait_ns = static_cast<std::int64_t>(config_.max_wait_s * 1e9);
  return std::erase_if(pending_,
                       [&](const auto& entry) { return now_ns - entry.second.arrival_ns > max_wait_ns; });
}

std::size_t Synchroniser::drop_excess() {
  std::size_t dropped = 0;
  for (; pending_.size() > static_cast<std::size_t>(config_.queue_capacity); ++dropped) {
    pending_.erase(pending_.begin());
  }
  return dropped;
}

std::size_t Synchroniser::clear_frames() {
  const auto count = pending_.size();
  pending_.clear();
  return count;
}

}  // namespace laneloom
