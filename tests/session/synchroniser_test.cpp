#include "session/synchroniser.hpp"

#include <gtest/gtest.h>

#include "milliseconds.hpp"

namespace laneloom::session {
namespace {

PendingFrame pending(std::int64_t stamp_ms, std::int64_t arrival_ms = 0) {
  return {.frame = {.stamp_ns = stamp_ms * kMs}, .arrival_ns = arrival_ms * kMs};
}

VehiclePose pose_at(std::int64_t stamp_ms) {
  return {.stamp_ns = stamp_ms * kMs, .position = {static_cast<double>(stamp_ms), 0.0, 0.0}};
}

class SynchroniserTest : public ::testing::Test {
 protected:
  /// Stamps of all frames that can be fused now, in milliseconds.
  std::vector<std::int64_t> ready() {
    std::vector<std::int64_t> stamps;
    while (const auto next = synchroniser_.next(refused_)) {
      stamps.push_back(next->pending.frame.stamp_ns / kMs);
      EXPECT_DOUBLE_EQ(next->T_map_body.translation().x(), static_cast<double>(stamps.back()));
    }
    return stamps;
  }
  using Stamps = std::vector<std::int64_t>;

  Synchroniser synchroniser_{SyncConfig{}};
  std::size_t refused_ = 0;
};

TEST_F(SynchroniserTest, AFrameWaitsForThePoseAfterIt) {
  synchroniser_.add(pose_at(100));
  synchroniser_.add(pending(150));
  EXPECT_EQ(ready(), Stamps{});
  EXPECT_EQ(synchroniser_.pending(), 1U);
  synchroniser_.add(pose_at(200));
  EXPECT_EQ(ready(), Stamps{150});
  EXPECT_EQ(synchroniser_.pending(), 0U);
}

TEST_F(SynchroniserTest, FramesComeInTheOrderOfTheirStamps) {
  synchroniser_.add(pose_at(100));
  for (const int stamp : {180, 120, 150, 220}) synchroniser_.add(pending(stamp));
  synchroniser_.add(pose_at(200));
  EXPECT_EQ(ready(), (Stamps{120, 150, 180}));
  synchroniser_.add(pose_at(300));
  EXPECT_EQ(ready(), Stamps{220});
}

TEST_F(SynchroniserTest, AFrameThatNoPoseCanMatchIsRefusedAndHoldsNothingUp) {
  synchroniser_.add(pose_at(100));
  synchroniser_.add(pending(50));
  synchroniser_.add(pending(150));
  synchroniser_.add(pose_at(200));
  EXPECT_EQ(ready(), Stamps{150});
  EXPECT_EQ(refused_, 1U);
  synchroniser_.add(pose_at(1000));
  synchroniser_.add(pending(600));
  EXPECT_EQ(ready(), Stamps{});
  EXPECT_EQ(refused_, 2U);
}

TEST_F(SynchroniserTest, AFrameWaitsForABoundedTimeFromItsArrival) {
  synchroniser_.add(pending(150, 1000));
  synchroniser_.add(pending(160, 1100));
  EXPECT_EQ(synchroniser_.expire(1500 * kMs), 0U);
  EXPECT_EQ(synchroniser_.expire(1501 * kMs), 1U);
  EXPECT_EQ(synchroniser_.pending(), 1U);
  synchroniser_.add(pose_at(100));
  synchroniser_.add(pose_at(200));
  EXPECT_EQ(ready(), Stamps{160});
}

TEST_F(SynchroniserTest, AFrameWhosePosesAreThereDoesNotExpire) {
  synchroniser_.add(pose_at(100));
  synchroniser_.add(pose_at(200));
  synchroniser_.add(pending(150));
  synchroniser_.add(pending(250));
  EXPECT_EQ(synchroniser_.ready(), 1U);
  EXPECT_EQ(synchroniser_.expire(10'000 * kMs), 1U) << "the other frame";
  EXPECT_EQ(ready(), Stamps{150});
  EXPECT_EQ(synchroniser_.ready(), 0U);
}

TEST_F(SynchroniserTest, AFloodOfOneSourceLeavesTheFramesOfAnother) {
  auto quiet = pending(10);
  quiet.frame.source = "quiet";
  synchroniser_.add(quiet);
  for (int i = 0; i < 70; ++i) synchroniser_.add(pending(100 + i));
  EXPECT_EQ(synchroniser_.drop_excess(), 7U);
  synchroniser_.add(pose_at(5));
  synchroniser_.add(pose_at(180));
  EXPECT_EQ(ready().front(), 10);
}

TEST_F(SynchroniserTest, KeepsTheNewestFramesOnly) {
  for (int i = 0; i < 70; ++i) synchroniser_.add(pending(100 + i));
  EXPECT_EQ(synchroniser_.drop_excess(), 6U);
  synchroniser_.add(pose_at(100));
  synchroniser_.add(pose_at(200));
  EXPECT_EQ(ready().front(), 106);
}

}  // namespace
}  // namespace laneloom::session
