#include "simulation/network_delay.hpp"

#include <gtest/gtest.h>

namespace laneloom {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;

TEST(NetworkDelay, FramesComeInOrderAfter50To150Milliseconds) {
  simulation::NetworkDelay<int> network(1);
  int next = 0;
  for (std::int64_t now_ms = 0; now_ms < 10'000; ++now_ms) {
    const std::int64_t now_ns = now_ms * kMillisecond_ns;
    if (now_ms % 100 == 0) network.put(static_cast<int>(now_ms / 100), now_ns);
    while (const auto frame = network.take(now_ns)) {
      EXPECT_EQ(*frame, next++);
      const std::int64_t delay_ms = now_ms - std::int64_t{100} * *frame;
      EXPECT_GE(delay_ms, 50);
      EXPECT_LE(delay_ms, 151);
    }
  }
  EXPECT_GE(next, 98);
}

TEST(NetworkDelay, MayBeTheSameForAllFrames) {
  simulation::NetworkDelay<int> network(1, 0.0);
  for (int i = 0; i < 10; ++i) {
    network.put(i, 1'000'000'000);
    EXPECT_FALSE(network.take(1'099'999'999).has_value());
    EXPECT_EQ(network.take(1'100'000'000), i);
  }
}

TEST(NetworkDelay, ClearedItGivesNothing) {
  simulation::NetworkDelay<int> network(1);
  network.put(1, 0);
  network.clear();
  EXPECT_FALSE(network.take(1000 * kMillisecond_ns));
}

}  // namespace
}  // namespace laneloom
