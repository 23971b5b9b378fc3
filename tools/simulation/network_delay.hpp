#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <utility>

#include "simulation/random.hpp"

namespace laneloom::simulation {

/// The time that a network takes for a frame, 50 to 150 ms. Frames keep their order: at ten frames a second,
/// the longest time is only a period more than the shortest.
template <class Frame>
class NetworkDelay {
 public:
  explicit NetworkDelay(std::uint64_t seed) : delays_(seed) {}

  /// Gives the network a frame.
  void put(Frame frame, std::int64_t now_ns) {
    const auto delay_ns = static_cast<std::int64_t>(delays_.uniform(50e6, 150e6));
    pending_.push_back({now_ns + delay_ns, std::move(frame)});
  }

  /// Takes the next frame that is done. Empty: there is none yet.
  std::optional<Frame> take(std::int64_t now_ns) {
    if (pending_.empty() || pending_.front().due_ns > now_ns) return std::nullopt;
    Frame frame = std::move(pending_.front().frame);
    pending_.pop_front();
    return frame;
  }

  /// Drops all frames that are not done.
  void clear() { pending_.clear(); }

 private:
  struct Pending {
    std::int64_t due_ns = 0;
    Frame frame;
  };

  Random delays_;
  std::deque<Pending> pending_;
};

}  // namespace laneloom::simulation
