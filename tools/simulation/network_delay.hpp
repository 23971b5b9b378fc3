#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <utility>

#include "simulation/random.hpp"

namespace laneloom::simulation {

/// The time that a network takes for a frame: 100 ms in the mean, 50 to 150 ms unless another spread is
/// given. Frames keep their order: at ten frames a second, the longest time is at most a period more than the
/// shortest.
template <class Frame>
class NetworkDelay {
 public:
  /// `spread_ms` (0 to 100): the longest time minus the shortest.
  explicit NetworkDelay(std::uint64_t seed, double spread_ms = 100.0)
      : delays_(seed), spread_ns_(1e6 * spread_ms) {}

  /// Gives the network a frame.
  void put(Frame frame, std::int64_t now_ns) {
    const auto delay_ns =
        static_cast<std::int64_t>(delays_.uniform(kMean_ns - 0.5 * spread_ns_, kMean_ns + 0.5 * spread_ns_));
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

  static constexpr double kMean_ns = 100e6;
  Random delays_;
  double spread_ns_;
  std::deque<Pending> pending_;
};

}  // namespace laneloom::simulation
