#include "core/readiness.hpp"

#include <gtest/gtest.h>

namespace laneloom::core {
namespace {

TEST(Readiness, IsOfAFrameWhosePoseCame) {
  Readiness readiness;
  EXPECT_FALSE(readiness.note_frame(100));
  EXPECT_FALSE(readiness.note_frame(120));
  EXPECT_EQ(readiness.note_pose(90), 0U);
  EXPECT_EQ(readiness.note_pose(100), 1U);
  EXPECT_TRUE(readiness.note_frame(95));
  EXPECT_EQ(readiness.note_pose(130), 1U);
  EXPECT_EQ(readiness.note_pose(140), 0U) << "each frame once";
}

TEST(Readiness, IsJudgedByTheNewestPoseAlone) {
  Readiness readiness;
  readiness.note_pose(1'000'000);
  readiness.note_pose(50);  // of a new clock
  EXPECT_FALSE(readiness.note_frame(100));
  EXPECT_EQ(readiness.note_pose(100), 1U);
}

TEST(Readiness, ForgetsFramesThatWaitInVain) {
  Readiness readiness;
  for (int i = 0; i < 1000; ++i) EXPECT_FALSE(readiness.note_frame(100 + i));
  EXPECT_EQ(readiness.note_pose(10'000), 64U);
}

}  // namespace
}  // namespace laneloom::core
