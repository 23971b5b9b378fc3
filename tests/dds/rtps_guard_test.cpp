#include "dds/rtps_guard.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <random>

#include "dds/rtps_datagrams.hpp"

namespace laneloom::dds {
namespace {

using Refusal = std::optional<DatagramRefusal>;

constexpr std::uint32_t kWriter = 0x00000103, kReader = 0x00000104, kPublications = 0x000003c2;
constexpr Prefix kPeer{1, 15, 7};

/// A guard at a time that stands still until it is moved.
class RtpsGuardTest : public ::testing::Test {
 protected:
  Refusal check(const Packet& bytes) { return guard_.check(bytes, now_ns_); }
  Refusal check_all(const std::vector<Packet>& submessages) { return check(datagram(kPeer, submessages)); }

  RtpsGuard guard_;
  std::int64_t now_ns_ = 1;
};

RtpsWriter data_of(std::uint32_t writer, std::int64_t sequence) {
  return RtpsWriter().u16(0).u16(16).entity(0).entity(writer).sequence(sequence);
}
Packet data(std::int64_t sequence) {
  return submessage(0x15, 4, data_of(kWriter, sequence).u32(0x0100).zeros(8).take());
}
/// An announcement of an endpoint with these parameters.
Packet announcement(const Packet& parameters) {
  return submessage(0x15, 4, data_of(kPublications, 1).u8(0).u8(3).u16(0).bytes(parameters).take());
}
Packet parameter(std::uint16_t id, const Packet& value) {
  return RtpsWriter().u16(id).u16(static_cast<std::uint16_t>(value.size())).bytes(value).take();
}
const Packet kEndOfParameters = parameter(1, {});

struct Cut {
  std::uint32_t first = 1;
  std::uint16_t count = 1, fragment_bytes = 1024;
  std::uint32_t sample_bytes = 3000;
  std::size_t payload_bytes = 1024;
};
Packet fragments(const Cut& cut, std::int64_t sequence = 1) {
  const auto fixed = RtpsWriter()
                         .u16(0)
                         .u16(28)
                         .entity(kReader)
                         .entity(kWriter)
                         .sequence(sequence)
                         .u32(cut.first)
                         .u16(cut.count)
                         .u16(cut.fragment_bytes)
                         .u32(cut.sample_bytes);
  return submessage(0x16, 0, RtpsWriter(fixed).zeros(cut.payload_bytes).take());
}
std::size_t bitmap_bytes(std::size_t bits) { return (bits + 31) / 32 * 4; }

Packet gap(std::int64_t start, std::int64_t base, std::uint32_t bits = 0) {
  return submessage(0x08, 0,
                    RtpsWriter()
                        .entity(kReader)
                        .entity(kWriter)
                        .sequence(start)
                        .sequence(base)
                        .u32(bits)
                        .zeros(bitmap_bytes(bits))
                        .take());
}
Packet ack_nack(std::int64_t base, std::uint32_t bits) {
  return submessage(0x06, 0,
                    RtpsWriter()
                        .entity(kReader)
                        .entity(kWriter)
                        .sequence(base)
                        .u32(bits)
                        .zeros(bitmap_bytes(bits))
                        .u32(1)
                        .take());
}

TEST_F(RtpsGuardTest, TheThreeDatagramsOfAStrangerAreRefused) {
  EXPECT_EQ(check(vendor_submessage_in_the_midst()), DatagramRefusal::vendor);
  EXPECT_EQ(check(fragments_beyond_their_sample()), DatagramRefusal::fragments);
  EXPECT_EQ(check(heartbeat_that_leaps(kPeer, std::int64_t{1} << 62)), DatagramRefusal::sequence);
  EXPECT_EQ(check(heartbeat_that_leaps(kPeer, std::int64_t{1} << 30)), DatagramRefusal::leap);
}

TEST_F(RtpsGuardTest, ADatagramBeginsWithAHeaderOfVersionTwo) {
  EXPECT_EQ(check(Packet()), DatagramRefusal::header);
  auto bytes = datagram(kPeer, {});
  EXPECT_EQ(check(bytes), Refusal());
  bytes[4] = 3;
  EXPECT_EQ(check(bytes), DatagramRefusal::header);
  bytes[4] = 2;
  bytes.pop_back();
  EXPECT_EQ(check(bytes), DatagramRefusal::header);
}

TEST_F(RtpsGuardTest, ASubmessageLiesWithinItsDatagram) {
  auto bytes = datagram(kPeer, {data(1)});
  EXPECT_EQ(check(bytes), Refusal());
  bytes[22] = bytes[23] = 0;  // a length of 0 runs to the end
  EXPECT_EQ(check(bytes), Refusal());
  bytes[22] = 0xff;
  EXPECT_EQ(check(bytes), DatagramRefusal::length);
  EXPECT_EQ(check_all({submessage(0x09, 2, {}), data(1)}), Refusal());  // an invalid time is empty
  EXPECT_EQ(check_all({submessage(0x09, 0, {}), data(1)}), DatagramRefusal::length);
  EXPECT_EQ(check_all({submessage(0x0e, 0, Packet(8))}), DatagramRefusal::length);
  EXPECT_EQ(check_all({submessage(0x0c, 0, Packet(16))}), DatagramRefusal::length);
  EXPECT_EQ(check_all({submessage(0x15, 4, Packet(12))}), DatagramRefusal::length);
  EXPECT_EQ(check_all({Packet(3)}), DatagramRefusal::length);
}

TEST_F(RtpsGuardTest, OnlyKnownSubmessagesPassAndThoseOfVendorsAtTheEnd) {
  EXPECT_EQ(check_all({submessage(0x22, 0, Packet(4))}), DatagramRefusal::kind);
  EXPECT_EQ(check_all({data(1), submessage(0x80, 0, Packet(56))}), Refusal());
  EXPECT_EQ(check_all({submessage(0x80, 0, Packet(56)), data(1)}), DatagramRefusal::vendor);
  EXPECT_EQ(check_all({submessage(0x80, 0, Packet(56)), Packet(1)}), DatagramRefusal::vendor);
}

// Connext is not there to be recorded: by what is published of it (vendor 01.01; Wireshark's packet-rtps.c).
TEST_F(RtpsGuardTest, WhatConnextSendsPasses) {
  const auto from_connext = [](Packet bytes) {
    bytes[7] = 1;
    return bytes;
  };
  const auto product_version = parameter(0x8000, Packet{7, 3, 0, 0}),
             transports = parameter(0x8010, Packet(44)), lease = parameter(0x8016, Packet(8)),
             endpoints = parameter(0x8017, Packet(4)), type_object = parameter(0x8021, Packet(60)),
             filters = parameter(0x8003, Packet(8));
  auto parameters = RtpsWriter();
  for (const auto& one :
       {product_version, transports, lease, endpoints, type_object, filters, kEndOfParameters})
    parameters.bytes(one);
  EXPECT_EQ(check(from_connext(datagram(kPeer, {announcement(parameters.take())}))), Refusal());
  for (const int kind : {0x14, 0x17, 0x18, 0x19, 0x1a, 0x1b, 0x1c, 0x1d, 0x1e})
    EXPECT_EQ(check(from_connext(
                  datagram(kPeer, {submessage(static_cast<std::uint8_t>(kind), 0, Packet(28)), data(1)}))),
              Refusal());
  const auto checksum = submessage(0x80, 0, Packet(8));
  EXPECT_EQ(check(from_connext(datagram(kPeer, {checksum, data(1)}))), Refusal());
}

TEST_F(RtpsGuardTest, SecuredSubmessagesAreNotLookedInto) {
  for (std::uint8_t kind = 0x30; kind <= 0x34; ++kind)
    EXPECT_EQ(check_all({submessage(kind, 0, RtpsWriter().zeros(4).bytes(Packet(20, 0xab)).take())}),
              Refusal());
}

// Fast DDS 2.9 decrypts what lies beyond its datagram.
TEST_F(RtpsGuardTest, EncryptedSubmessagesHaveAsManyBytesAsTheySay) {
  const auto encrypted = [&](std::uint8_t length) {
    return check_all({submessage(0x30, 0, RtpsWriter().zeros(3).u8(length).zeros(20).take())});
  };
  EXPECT_EQ(encrypted(20), Refusal());
  EXPECT_EQ(encrypted(21), DatagramRefusal::length);
}

TEST_F(RtpsGuardTest, WhereAllIsProtectedOnlyTheWayToKeysIsClear) {
  guard_ = RtpsGuard(true);
  const auto clear = [&](std::uint32_t writer) {
    return check_all({submessage(0x09, 0, Packet(8)), submessage(0x15, 0, data_of(writer, 1).take())});
  };
  EXPECT_EQ(clear(0x000100c2), Refusal());
  EXPECT_EQ(clear(0x000201c3), Refusal());
  EXPECT_EQ(clear(kPublications), DatagramRefusal::clear);
  EXPECT_EQ(clear(kWriter), DatagramRefusal::clear);
  EXPECT_EQ(check_all({heartbeat(kReader, kWriter, 1, 1)}), DatagramRefusal::clear);
  EXPECT_EQ(check_all({ack_nack(1, 0)}), DatagramRefusal::clear);
  EXPECT_EQ(check_all({gap(1, 2)}), DatagramRefusal::clear);
  EXPECT_EQ(check_all({submessage(0x33, 0, Packet(20)), heartbeat(kReader, kWriter, 1, 1)}), Refusal())
      << "signed as a whole";
}

TEST_F(RtpsGuardTest, FragmentsFitToTheirSample) {
  EXPECT_EQ(check_all({fragments({})}), Refusal());
  EXPECT_EQ(check_all({fragments({.first = 3, .payload_bytes = 952})}), Refusal());
  EXPECT_EQ(check_all({fragments({.first = 2, .count = 2, .payload_bytes = 1976})}), Refusal());
  for (const Cut& wrong :
       {Cut{.first = 0}, Cut{.first = 4}, Cut{.count = 0}, Cut{.count = 4, .payload_bytes = 4096},
        Cut{.fragment_bytes = 0}, Cut{.fragment_bytes = 4, .payload_bytes = 4}, Cut{.sample_bytes = 0},
        Cut{.sample_bytes = 1U << 31U}, Cut{.payload_bytes = 1000}, Cut{.first = 3, .payload_bytes = 900},
        Cut{.fragment_bytes = 1477, .sample_bytes = 1480, .payload_bytes = 1477}})
    EXPECT_EQ(check_all({fragments(wrong, 9)}), DatagramRefusal::fragments);
}

TEST_F(RtpsGuardTest, ASampleIsCutInOneWay) {
  EXPECT_EQ(check_all({fragments({})}), Refusal());
  EXPECT_EQ(check_all({fragments({.sample_bytes = 4000})}), DatagramRefusal::fragments);
  EXPECT_EQ(check_all({fragments({.sample_bytes = 4000}, 2)}), Refusal());
}

TEST_F(RtpsGuardTest, SequenceNumbersArePositiveAndInOrder) {
  EXPECT_EQ(check_all({data(0)}), DatagramRefusal::sequence);
  EXPECT_EQ(check_all({data(-5)}), DatagramRefusal::sequence);
  EXPECT_EQ(check_all({data(std::int64_t{1} << 41)}), DatagramRefusal::sequence);
  EXPECT_EQ(check_all({heartbeat(kReader, kWriter, 1, 0)}), Refusal());
  EXPECT_EQ(check_all({heartbeat(kReader, kWriter, 5, 3)}), DatagramRefusal::sequence);
  EXPECT_EQ(check_all({heartbeat(kReader, kWriter, 0, 3)}), DatagramRefusal::sequence);
  EXPECT_EQ(check_all({gap(0, 3)}), DatagramRefusal::sequence);
  EXPECT_EQ(check_all({gap(3, 2)}), DatagramRefusal::sequence);
  EXPECT_EQ(check_all({ack_nack(0, 0)}), Refusal()) << "the first one of Fast DDS";
  EXPECT_EQ(check_all({ack_nack(-1, 0)}), DatagramRefusal::sequence);
}

TEST_F(RtpsGuardTest, AWriterThatIsKnownDoesNotLeap) {
  constexpr std::int64_t kLong = std::int64_t{1} << 31;
  EXPECT_EQ(check_all({heartbeat(kReader, kWriter, kLong, kLong)}), Refusal()) << "one that has run for long";
  EXPECT_EQ(check_all({data(kLong + 1000)}), Refusal());
  EXPECT_EQ(check_all({heartbeat(kReader, kWriter, 1, kLong + (1 << 22))}), DatagramRefusal::leap);
  EXPECT_EQ(check_all({data(kLong + (1 << 22))}), DatagramRefusal::leap);
  EXPECT_EQ(check_all({gap(kLong, kLong + (1 << 20))}), DatagramRefusal::leap);
  EXPECT_EQ(check_all({gap(kLong, kLong + 2000)}), Refusal());
  EXPECT_EQ(check_all({data(7)}), Refusal()) << "one that began anew";
  now_ns_ += 61'000'000'000;
  EXPECT_EQ(check_all({data(kLong + (1 << 22))}), Refusal()) << "the network was cut for long";
}

TEST_F(RtpsGuardTest, AWriterSkipsFewNumbersForEachSecond) {
  // Fast DDS would remember each of them.
  constexpr std::int64_t kMany = 40'000, kFew = 1000, kSecond_ns = 1'000'000'000;
  EXPECT_EQ(check_all({gap(5, 5 + kMany), gap(5 + kMany, 5 + 2 * kMany)}), DatagramRefusal::leap);
  EXPECT_EQ(check_all({gap(5, 5 + kMany)}), Refusal());
  EXPECT_EQ(check_all({gap(5 + kMany, 5 + 2 * kMany)}), DatagramRefusal::leap);
  EXPECT_EQ(check_all({gap(5 + 2 * kMany, 5 + 2 * kMany + kFew)}), Refusal());
  now_ns_ += 100 * kSecond_ns;
  EXPECT_EQ(check_all({gap(5, 5 + kMany)}), Refusal()) << "one that is asked for them again";
  for (int i = 0; i < 100; ++i) {
    now_ns_ += kSecond_ns / 100;
    ASSERT_EQ(check_all({gap(5 + kMany + i, 6 + kMany + i)}), Refusal())
        << "one that skips each of its messages";
  }
}

/// A reader that hangs asks for the same numbers at each heartbeat. What it is told, all readers hear.
TEST_F(RtpsGuardTest, AWriterMaySkipTheSameNumbersAgainAndAgain) {
  for (std::int64_t i = 0; i < 5000; ++i) {
    now_ns_ += 20'000'000;
    ASSERT_EQ(check_all({gap(5, 305 + i / 5, 256)}), Refusal()) << i;
    ASSERT_EQ(check_all({gap(200, 300)}), Refusal()) << "another reader";
  }
}

TEST_F(RtpsGuardTest, OneThatSkipsHereAndThereIsCounted) {
  constexpr std::int64_t kMany = 30'000;
  EXPECT_EQ(check_all({gap(5, 5 + kMany)}), Refusal());
  EXPECT_EQ(check_all({gap(7 + kMany, 7 + 2 * kMany)}), Refusal());
  EXPECT_EQ(check_all({gap(5, 5 + kMany)}), DatagramRefusal::leap);
}

TEST_F(RtpsGuardTest, NumbersOfASetAreSkippedToo) {
  constexpr int kSets = 257;
  for (int i = 1; i < kSets; ++i)
    ASSERT_EQ(check_all({gap(256 * i, 256 * i + 1, 254)}), i < 256 ? Refusal() : DatagramRefusal::leap);
}

TEST_F(RtpsGuardTest, ARefusedDatagramIsNotBelievedInAnything) {
  EXPECT_EQ(check_all({data(1), data(1'000'000), submessage(0x22, 0, {})}), DatagramRefusal::kind);
  EXPECT_EQ(check_all({data(1)}), Refusal());
  EXPECT_EQ(check_all({data(1'500'000)}), DatagramRefusal::leap);
}

TEST_F(RtpsGuardTest, WritersBeyondTheMemoryAreForgottenOldestFirst) {
  const auto from = [&](std::uint32_t entity, std::int64_t last) {
    return check_all({heartbeat(kReader, entity, 1, last)});
  };
  EXPECT_EQ(from(kWriter, 10), Refusal());
  for (std::uint32_t i = 0; i < 4095; ++i) ASSERT_EQ(from((i + 2) << 8U | 3U, 10), Refusal());
  EXPECT_EQ(from(kWriter, 10'000'000), DatagramRefusal::leap);
  EXPECT_EQ(from(0x00ff0003, 10), Refusal());
  EXPECT_EQ(from(kWriter, 10'000'000), Refusal());
}

TEST_F(RtpsGuardTest, SetsHaveAtMost256Numbers) {
  EXPECT_EQ(check_all({ack_nack(1, 256)}), Refusal());
  EXPECT_EQ(check_all({ack_nack(1, 257)}), DatagramRefusal::bitmap);
  EXPECT_EQ(check_all({gap(1, 2, 257)}), DatagramRefusal::bitmap);
  const auto nack_fragments = [&](std::uint32_t base, std::uint32_t bits) {
    const auto fixed = RtpsWriter().entity(kReader).entity(kWriter).sequence(1).u32(base).u32(bits);
    return check_all({submessage(0x12, 0, RtpsWriter(fixed).zeros(bitmap_bytes(bits) + 4).take())});
  };
  EXPECT_EQ(nack_fragments(1, 256), Refusal());
  EXPECT_EQ(nack_fragments(1, 257), DatagramRefusal::bitmap);
  EXPECT_EQ(nack_fragments(0, 1), DatagramRefusal::fragments);
}

TEST_F(RtpsGuardTest, ListsOfParametersEnd) {
  const auto text = [](std::uint32_t length) { return RtpsWriter().u32(length).zeros(8).take(); };
  const auto passes = [&](const Packet& parameters) { return check_all({announcement(parameters)}); };
  EXPECT_EQ(passes(kEndOfParameters), Refusal());
  EXPECT_EQ(passes(RtpsWriter().bytes(parameter(5, text(8))).bytes(kEndOfParameters).take()), Refusal());
  EXPECT_EQ(passes({}), DatagramRefusal::parameters);
  EXPECT_EQ(passes(parameter(5, text(8))), DatagramRefusal::parameters);
  for (const auto& wrong :
       {parameter(5, text(9)), parameter(0x29, text(3)), parameter(0x59, text(0xffffffff)),
        parameter(0x2c, text(9)), parameter(0x2f, text(1)), parameter(0x73, text(5)),
        parameter(0x8006, text(0x10000))})
    EXPECT_EQ(passes(RtpsWriter().bytes(wrong).bytes(kEndOfParameters).take()), DatagramRefusal::parameters);
}

TEST_F(RtpsGuardTest, AnnouncementsInFragmentsAreSoundAsAWhole) {
  const Packet sound = reader_with_representations(2), wrong = reader_with_representations(0xffffffff);
  const auto fragment = [&](const Packet& payload, std::int64_t sequence, std::uint32_t n) {
    return check(announced_fragment(kPeer, sequence, payload, n));
  };
  for (const std::uint32_t n : {1U, 3U, 3U, 2U, 1U}) EXPECT_EQ(fragment(sound, 1, n), Refusal()) << n;
  for (const std::uint32_t n : {3U, 1U}) EXPECT_EQ(fragment(wrong, 2, n), Refusal()) << n;
  EXPECT_EQ(fragment(wrong, 2, 2), DatagramRefusal::parameters) << "it makes the announcement whole";
  EXPECT_EQ(fragment(sound, 3, 2), Refusal());
  EXPECT_EQ(fragment(wrong, 3, 2), DatagramRefusal::parameters) << "another content than before";
  EXPECT_EQ(check(announced_whole(kPeer, 4, sound)), Refusal());
  EXPECT_EQ(check(announced_whole(kPeer, 5, wrong)), DatagramRefusal::parameters);
}

TEST_F(RtpsGuardTest, AnnouncementsInFragmentsAreBounded) {
  const Packet large(65537);
  EXPECT_EQ(check(announced_fragment(kPeer, 1, large, 1)), DatagramRefusal::parameters);
  const Packet sound = reader_with_representations(2);
  for (std::int64_t sequence = 2; sequence < 100; ++sequence)
    EXPECT_EQ(check(announced_fragment(kPeer, sequence, sound, 1)), Refusal());
}

/// A token of DDS-Security with these numbers of properties, and of properties of bytes.
Packet token(std::uint32_t properties, std::uint32_t binary) {
  const auto text = RtpsWriter().u32(4).text("abc").u8(0).take();
  return RtpsWriter()
      .bytes(text)
      .u32(properties)
      .bytes(text)
      .bytes(text)
      .u32(binary)
      .bytes(text)
      .bytes(text)
      .take();
}

TEST_F(RtpsGuardTest, TokensHaveAsManyPropertiesAsTheySay) {
  const auto passes = [&](const Packet& value) {
    return check_all(
        {announcement(RtpsWriter().bytes(parameter(0x1001, value)).bytes(kEndOfParameters).take())});
  };
  EXPECT_EQ(passes(token(1, 1)), Refusal());
  EXPECT_EQ(passes(token(1, 2)), DatagramRefusal::parameters);
  EXPECT_EQ(passes(token(0x7fffffff, 1)), DatagramRefusal::parameters);
  EXPECT_EQ(passes(token(1, 0xffffffff)), DatagramRefusal::parameters);
}

// Fast DDS 2.9 ends over a handshake that tells of more tokens than it has memory for.
TEST_F(RtpsGuardTest, HandshakesAreSoundAndWhole) {
  constexpr std::uint32_t kHandshakes = 0x000201c3;
  const auto handshake = [&](std::uint32_t tokens, const Packet& one) {
    const auto fixed = data_of(kHandshakes, 1).u32(0x0100).zeros(96).u32(4).text("abc").u8(0);
    return check_all({submessage(0x15, 4, RtpsWriter(fixed).u32(tokens).bytes(one).take())});
  };
  EXPECT_EQ(handshake(1, token(1, 1)), Refusal());
  EXPECT_EQ(handshake(0, {}), Refusal());
  EXPECT_EQ(handshake(2, token(1, 1)), DatagramRefusal::parameters);
  EXPECT_EQ(handshake(0x40000000, token(1, 1)), DatagramRefusal::parameters);
  EXPECT_EQ(handshake(1, token(0x40000000, 1)), DatagramRefusal::parameters);
  auto in_pieces = fragments({});
  in_pieces[12] = 0x00, in_pieces[13] = 0x02, in_pieces[14] = 0x01, in_pieces[15] = 0xc3;
  EXPECT_EQ(check_all({in_pieces}), DatagramRefusal::fragments);
}

// Fast DDS 2.9 takes a sample without a writer for a handshake.
TEST_F(RtpsGuardTest, SamplesHaveAWriter) {
  EXPECT_EQ(check_all({submessage(0x15, 4, data_of(0, 1).u32(0x0100).zeros(8).take())}),
            DatagramRefusal::writer);
  auto of_nobody = fragments({});
  of_nobody[12] = of_nobody[13] = of_nobody[14] = of_nobody[15] = 0;
  EXPECT_EQ(check_all({of_nobody}), DatagramRefusal::writer);
}

TEST_F(RtpsGuardTest, ParametersOfAnySampleEnd) {
  const auto inline_qos = RtpsWriter(data_of(kWriter, 1)).bytes(parameter(0x71, Packet(4))).take();
  EXPECT_EQ(check_all({submessage(0x15, 2, inline_qos)}), DatagramRefusal::parameters);
}

/// Bytes of no sense are read within their bounds: a sanitizer, or the end of a page, would tell.
TEST_F(RtpsGuardTest, DamagedDatagramsDoNoHarm) {
  const std::vector<Packet> seeds{
      datagram(kPeer, {data(1), heartbeat(kReader, kWriter, 1, 1), gap(1, 2, 40), ack_nack(1, 60)}),
      datagram(kPeer, {fragments({.first = 3, .payload_bytes = 952}), submessage(0x80, 0, Packet(56))}),
      datagram(kPeer, {announcement(RtpsWriter().bytes(parameter(5, Packet(12))).take())})};
  std::mt19937 random(1);  // NOLINT(bugprone-random-generator-seed,cert-msc51-cpp): the same at every run
  std::size_t refused = 0;
  for (int i = 0; i < 100'000; ++i) {
    Packet bytes = seeds[random() % seeds.size()];
    for (auto changes = 1 + random() % 4; changes > 0; --changes)
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    bytes.resize(1 + random() % bytes.size());
    bytes.shrink_to_fit();
    refused += check(bytes).has_value() ? 1U : 0U;
  }
  EXPECT_GT(refused, 50'000U);
}

}  // namespace
}  // namespace laneloom::dds
