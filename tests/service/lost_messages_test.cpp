#include "service/lost_messages.hpp"

#include <gtest/gtest.h>

namespace laneloom {
namespace {

constexpr dds::WriterId kOne{1}, kOther{2};

TEST(LostMessages, AreTheNumbersBetweenTwoThatCame) {
  LostMessages lost;
  EXPECT_EQ(lost.before(kOne, 50), 0U);  // what was written before we knew it was not for us
  EXPECT_EQ(lost.before(kOne, 51), 0U);
  EXPECT_EQ(lost.before(kOne, 55), 3U);
  EXPECT_EQ(lost.before(kOne, 56), 0U);
}

TEST(LostMessages, AreCountedByWriter) {
  LostMessages lost;
  lost.before(kOne, 10);
  EXPECT_EQ(lost.before(kOther, 100), 0U);
  EXPECT_EQ(lost.before(kOne, 12), 1U);
  EXPECT_EQ(lost.before(kOther, 101), 0U);
}

TEST(LostMessages, AreNoneWhenANumberComesAgain) {
  LostMessages lost;
  lost.before(kOne, 10);
  EXPECT_EQ(lost.before(kOne, 10), 0U);
  EXPECT_EQ(lost.before(kOne, 9), 0U);
  EXPECT_EQ(lost.before(kOne, 11), 0U);
}

}  // namespace
}  // namespace laneloom
