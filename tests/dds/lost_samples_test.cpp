#include "dds/lost_samples.hpp"

#include <gtest/gtest.h>

namespace laneloom::dds {
namespace {

using namespace eprosima::fastrtps::rtps;

SampleIdentity sample(unsigned char writer, std::uint64_t number) {
  SampleIdentity identity;
  identity.writer_guid().entityId.value[0] = writer;
  identity.sequence_number() = SequenceNumber_t(number);
  return identity;
}

TEST(LostSamples, AreTheNumbersBetweenTwoThatCame) {
  LostSamples lost;
  EXPECT_EQ(lost.before(sample(1, 50)), 0U);  // what was written before we knew it was not for us
  EXPECT_EQ(lost.before(sample(1, 51)), 0U);
  EXPECT_EQ(lost.before(sample(1, 55)), 3U);
  EXPECT_EQ(lost.before(sample(1, 56)), 0U);
}

TEST(LostSamples, AreCountedByWriter) {
  LostSamples lost;
  lost.before(sample(1, 10));
  EXPECT_EQ(lost.before(sample(2, 100)), 0U);
  EXPECT_EQ(lost.before(sample(1, 12)), 1U);
  EXPECT_EQ(lost.before(sample(2, 101)), 0U);
}

TEST(LostSamples, AreNoneWhenANumberComesAgain) {
  LostSamples lost;
  lost.before(sample(1, 10));
  EXPECT_EQ(lost.before(sample(1, 10)), 0U);
  EXPECT_EQ(lost.before(sample(1, 9)), 0U);
  EXPECT_EQ(lost.before(sample(1, 11)), 0U);
}

}  // namespace
}  // namespace laneloom::dds
