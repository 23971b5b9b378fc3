#include "service/lost_messages.hpp"

#include <gtest/gtest.h>

namespace laneloom::service {
namespace {

constexpr dds::WriterId kOne{1}, kOther{2};

TEST(LostMessages, AreTheNumbersBetweenThoseThatCame) {
  LostMessages lost;
  lost.note(kOne, 50);  // the writer wrote 49 messages before it was known
  lost.note(kOne, 51);
  EXPECT_EQ(lost.total(), 0U);
  lost.note(kOne, 55);
  EXPECT_EQ(lost.total(), 3U);
}

TEST(LostMessages, AreCountedByWriter) {
  LostMessages lost;
  lost.note(kOne, 10);
  lost.note(kOther, 100);
  EXPECT_EQ(lost.total(), 0U);
  lost.note(kOne, 12);
  lost.note(kOther, 103);
  EXPECT_EQ(lost.total(), 3U);
}

TEST(LostMessages, AreNotLostOnceTheyComeAfterNewerOnes) {
  LostMessages lost;
  for (const std::uint64_t number : {10U, 13U, 11U}) lost.note(kOne, number);
  EXPECT_EQ(lost.total(), 1U);
  lost.note(kOne, 9);
  EXPECT_EQ(lost.total(), 1U) << "from before the first";
  lost.note(kOne, 12);
  EXPECT_EQ(lost.total(), 0U);
}

TEST(LostMessages, AreRememberedWhenTheirWritersAreForgotten) {
  LostMessages lost;
  lost.note(kOne, 1);
  lost.note(kOne, 3);
  for (std::uint8_t i = 0; i < 255; ++i)
    for (std::uint8_t j = 0; j < 5; ++j) lost.note({9, i, j}, 1);
  EXPECT_EQ(lost.total(), 1U);
}

}  // namespace
}  // namespace laneloom::service
