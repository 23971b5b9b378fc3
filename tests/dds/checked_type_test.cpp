#include "dds/checked_type.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "cdr/random_messages.hpp"
#include "dds/topic_traits.hpp"

namespace laneloom::dds {
namespace {

using Payload = eprosima::fastdds::rtps::SerializedPayload_t;
using Bytes = std::vector<std::uint8_t>;
constexpr std::size_t kEncapsulation = 4;

/// The same message from a writer that does not protect it, so that damage reaches what reads it.
Bytes unprotected(Bytes bytes) {
  std::fill_n(bytes.begin() + kEncapsulation, 12, std::uint8_t{0});  // crc and data_id
  return bytes;
}

/// Serialises and deserialises as Fast DDS does.
template <class T>
class CheckedTypeTest : public ::testing::Test {
 protected:
  using Message = MessageOf<T>;

  Bytes bytes_of(const Message& message) {
    Sample<Message> sample{message};
    Payload payload(type_.bytes(&sample));
    EXPECT_TRUE(type_.write(&sample, payload));
    return {payload.data, payload.data + payload.length};
  }
  Sample<Message> read(const Bytes& bytes) {
    Payload payload(static_cast<std::uint32_t>(bytes.size()) + 1);
    if (!bytes.empty()) std::memcpy(payload.data, bytes.data(), bytes.size());
    payload.length = static_cast<std::uint32_t>(bytes.size());
    Sample<Message> sample;
    EXPECT_TRUE(type_.read(payload, &sample));
    return sample;
  }
  Message random(unsigned seed) {
    Message message;
    RandomMessages(seed).fill(message);
    return message;
  }

  typename TopicTraits<T>::Type type_;
};

using Types = ::testing::Types<DetectionFrame, VehiclePose, TrackedObjects, NextTurn, PublishedMap,
                               RoadMarkings, ServiceStatus>;
TYPED_TEST_SUITE(CheckedTypeTest, Types);

TYPED_TEST(CheckedTypeTest, WhatIsWrittenIsRead) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    const auto message = this->random(seed);
    auto sample = this->read(this->bytes_of(message));
    EXPECT_EQ(sample.refusal, "") << seed;
    EXPECT_EQ(sample.message.header().data_id(), kDataId<MessageOf<TypeParam>>);
    sample.message.header().crc(message.header().crc());
    sample.message.header().data_id(message.header().data_id());
    EXPECT_TRUE(sample.message == message) << seed;
  }
  // Empty lists are aligned differently.
  EXPECT_EQ(this->read(this->bytes_of({})).refusal, "");
}

TYPED_TEST(CheckedTypeTest, EveryFlippedBitIsRefused) {
  const auto bytes = this->bytes_of({});
  for (std::size_t bit = 8 * kEncapsulation; bit < 8 * bytes.size(); ++bit) {
    auto damaged = bytes;
    damaged[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
    EXPECT_NE(this->read(damaged).refusal, "") << bit;
  }
}

TYPED_TEST(CheckedTypeTest, EveryTruncationIsRefused) {
  for (const auto& bytes : {this->bytes_of(this->random(1)), unprotected(this->bytes_of(this->random(1)))}) {
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      const Bytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
      EXPECT_NE(this->read(cut).refusal, "") << size;
    }
  }
}

TYPED_TEST(CheckedTypeTest, TrailingBytesAreRefused) {
  auto bytes = unprotected(this->bytes_of(this->random(1)));
  bytes.insert(bytes.end(), 64, 0);
  EXPECT_EQ(this->read(bytes).refusal, "malformed");
}

TYPED_TEST(CheckedTypeTest, UnknownEncapsulationsAreRefused) {
  for (const std::uint8_t kind : Bytes{2, 3, 6, 7, 8, 9, 10, 11, 255}) {
    auto bytes = unprotected(this->bytes_of(this->random(1)));
    bytes[1] = kind;
    EXPECT_EQ(this->read(bytes).refusal, "malformed") << int{kind};
    bytes[0] = 1;
    EXPECT_EQ(this->read(bytes).refusal, "malformed");
  }
}

// Any length in the message becomes huge: nothing throws, and nothing of that size is allocated (the test
// would be ended for want of memory, as 4 G elements of any kind are more than the machine has).
TYPED_TEST(CheckedTypeTest, HugeLengthsAreRefusedWithoutHarm) {
  const auto bytes = unprotected(this->bytes_of(this->random(2)));
  for (std::size_t at = 4; at + 4 <= bytes.size(); at += 4) {
    auto damaged = bytes;
    std::memset(&damaged[at], 0xff, 4);
    this->read(damaged);
    damaged[at + 3] = 0x0f;
    this->read(damaged);
  }
}

TYPED_TEST(CheckedTypeTest, AHugeFirstStringIsRefused) {
  auto bytes = unprotected(this->bytes_of(this->random(2)));
  std::memset(&bytes[kEncapsulation + 40], 0xff, 4);  // length of the header's frame_id
  EXPECT_EQ(this->read(bytes).refusal, "malformed");
}

TYPED_TEST(CheckedTypeTest, RandomDamageNeverThrows) {
  const auto bytes = unprotected(this->bytes_of(this->random(3)));
  std::mt19937 engine(4);
  for (int round = 0; round < 3000; ++round) {
    auto damaged = bytes;
    for (int i = 0; i < 4; ++i) damaged[engine() % damaged.size()] = static_cast<std::uint8_t>(engine());
    this->read(damaged);
  }
}

TEST(CdrScanner, ReadsBothEndiannesses) {
  const Bytes big{0, 0, 0, 0, 0, 0, 0, 2, 'a', 0};
  const Bytes little{0, 1, 0, 0, 2, 0, 0, 0, 'a', 0};
  for (const auto& bytes : {big, little}) {
    CdrScanner cdr(bytes);
    cdr.text(1);
    EXPECT_TRUE(cdr.complete());
    CdrScanner tight(bytes);
    tight.text(0);
    EXPECT_FALSE(tight.complete());
  }
}

TEST(CdrScanner, RefusesATextWithoutItsEnd) {
  const Bytes bytes{0, 1, 0, 0, 2, 0, 0, 0, 'a', 'b'};
  CdrScanner cdr(bytes);
  cdr.text(8);
  EXPECT_FALSE(cdr.complete());
}

TEST(CdrScanner, RefusesATextWithAZeroInIt) {
  const Bytes bytes{0, 1, 0, 0, 6, 0, 0, 0, 'm', 'a', 'p', 0, 'x', 0};
  CdrScanner cdr(bytes);
  cdr.text(8);
  EXPECT_FALSE(cdr.complete());
}

}  // namespace
}  // namespace laneloom::dds
