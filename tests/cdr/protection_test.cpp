#include "cdr/protection.hpp"

#include <gtest/gtest.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cdr/crc64.hpp"
#include "cdr/random_messages.hpp"
#include "cdr/serialise.hpp"

namespace laneloom::dds {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes serialised() {
  Bytes bytes;
  serialise(RandomMessages(1).vehicle_pose(), bytes);
  return bytes;
}

std::string_view check(const Bytes& bytes) { return check_protection(bytes, msg::DATA_ID_VEHICLE_POSE); }

/// CRC-64/XZ, bit by bit.
std::uint64_t crc_of(std::string_view text) {
  std::uint64_t crc = ~0ULL;
  for (const char character : text) {
    crc ^= static_cast<std::uint8_t>(character);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xC96C5795D7870F42ULL : 0ULL);
  }
  return ~crc;
}

TEST(Crc64, IsThatOfSingleBitsForEveryLengthAndPlaceOfACut) {
  std::string text;
  for (int length = 0; length < 40; ++length) {
    const std::span bytes(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
    for (std::size_t cut = 0; cut <= bytes.size(); ++cut) {
      Crc64 crc;
      crc.add(bytes.first(cut));
      crc.add(bytes.subspan(cut));
      EXPECT_EQ(crc.value(), crc_of(text)) << length << " bytes, cut at " << cut;
    }
    text.push_back(static_cast<char>(37 * length + 200));
  }
}

TEST(Protection, IsTheCrcThatItSaysOfAMessageFilledUpWithZeros) {
  ASSERT_EQ(crc_of("123456789"), 0x995DC9BBDF1939FAULL);  // the check value in catalogues of CRCs
  Bytes message{0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  for (const char digit : std::string_view("56789")) message.push_back(static_cast<std::uint8_t>(digit));
  protect(message, 0x34333231);  // "1234" as little-endian bytes
  std::uint64_t crc = 0;
  for (std::size_t i = 0; i < 8; ++i) crc |= std::uint64_t{message[4 + i]} << 8 * i;
  EXPECT_EQ(crc, crc_of(std::string_view("123456789\0\0\0", 12)));
}

TEST(Protection, HoldsForAMessageThatTheTransportFilledUp) {
  for (std::uint8_t size = 17; size < 24; ++size) {
    Bytes message(size, 7);
    message[1] = 1;
    protect(message, msg::DATA_ID_VEHICLE_POSE);
    while (message.size() % 4 != 0) message.push_back(0);
    EXPECT_EQ(check(message), "") << int{size};
  }
}

TEST(Protection, HoldsForWhatIsSerialised) { EXPECT_EQ(check(serialised()), ""); }

TEST(Protection, SeesEveryFlippedBit) {
  const Bytes good = serialised();
  for (std::size_t bit = 8 * 4; bit < 8 * good.size(); ++bit) {
    Bytes bad = good;
    bad[bit / 8] = static_cast<std::uint8_t>(bad[bit / 8] ^ (1U << (bit % 8)));
    EXPECT_EQ(check(bad), "crc") << bit;
  }
}

TEST(Protection, SeesWhatWasCutOffAndAdded) {
  Bytes bytes = serialised();
  bytes.insert(bytes.end(), 4, 0);
  EXPECT_EQ(check(bytes), "crc");
  bytes.resize(bytes.size() - 8);
  EXPECT_EQ(check(bytes), "crc");
}

TEST(Protection, SeesAMessageOfAnotherTopic) {
  EXPECT_EQ(check_protection(serialised(), msg::DATA_ID_LANE_MAP), "data_id");
}

TEST(Protection, BelongsToTheByteOrder) {
  Bytes message = serialised();
  message[1] = 0;  // as if it were big-endian
  EXPECT_EQ(check(message), "crc");
  protect(message, msg::DATA_ID_VEHICLE_POSE);
  EXPECT_EQ(check(message), "");
}

TEST(Protection, IsNotAskedOfAWriterThatGivesNone) {
  Bytes message = serialised();
  std::fill(message.begin() + 4, message.begin() + 16, std::uint8_t{0});
  EXPECT_EQ(check(message), "");
}

TEST(Protection, DoesNotReadBeyondAShortMessage) {
  for (std::size_t size = 0; size < 16; ++size) {
    Bytes message(size, 1);
    protect(message, 1);
    EXPECT_EQ(check(message), "") << size;
  }
}

}  // namespace
}  // namespace laneloom::dds
