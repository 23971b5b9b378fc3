#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "dds/heard_writers.hpp"
#include "dds/rtps_announcements.hpp"
#include "dds/rtps_bytes.hpp"
#include "dds/rtps_guard.hpp"

namespace laneloom::dds {

/// The first bytes of a writer's id: its participant.
inline constexpr std::size_t kPrefixBytes = 12;
/// The kinds of submessages that may be empty.
inline constexpr std::uint8_t kPad = 0x01, kInfoTimestamp = 0x09;
/// The kind that begins a message which DDS-Security protects as a whole.
inline constexpr std::uint8_t kProtectedMessage = 0x33;

struct RtpsSubmessage {
  std::uint8_t kind = 0;
  std::uint8_t flags = 0;
  std::span<const std::uint8_t> body;
  bool ends_datagram = false;

  bool has_flag(unsigned bit) const { return (flags >> bit & 1U) != 0; }
  bool little_endian() const { return has_flag(0); }
};

/// Checks the submessages of one datagram, one after the other.
class SubmessageCheck {
 public:
  using Verdict = std::optional<DatagramRefusal>;  ///< nothing: no objection

  SubmessageCheck(const HeardWriters& heard, FragmentedAnnouncements& announcements,
                  std::span<const std::uint8_t, kPrefixBytes> prefix, std::int64_t now_ns);
  Verdict check(const RtpsSubmessage& submessage);
  /// Whether keys are agreed on by such submessages, or they are protected, or say nothing by themselves.
  bool may_be_clear(const RtpsSubmessage& submessage) const;
  /// Notes what the writers of the datagram have sent. A refused datagram is not believed in anything.
  void note_all(HeardWriters& heard) const;

 private:
  Verdict data(const RtpsSubmessage& submessage);
  Verdict data_fragments(const RtpsSubmessage& submessage);
  Verdict heartbeat(const RtpsSubmessage& submessage);
  Verdict gap(const RtpsSubmessage& submessage);
  Verdict info_source(const RtpsSubmessage& submessage);
  /// Refuses a number that the writer can not have come to; else remembers it.
  Verdict sent(const WriterId& writer, std::int64_t sequence);
  /// How many numbers more a writer has skipped in this datagram so far.
  std::int64_t skipped_by(const WriterId& writer) const;
  WriterId writer(RtpsBytes& bytes) const;

  struct Sent {
    WriterId writer{};
    std::int64_t sequence = 0;
    std::optional<Fragmentation> cut;
    std::optional<SequenceNumbers> skipped;
  };

  const HeardWriters& heard_;
  FragmentedAnnouncements& announcements_;
  WriterId source_{};  ///< the participant that speaks, and no entity
  std::int64_t now_ns_;
  std::vector<Sent> sent_;
};

}  // namespace laneloom::dds
