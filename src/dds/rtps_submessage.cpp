#include "dds/rtps_submessage.hpp"

#include <algorithm>
#include <array>

#include "dds/rtps_entities.hpp"
#include "dds/rtps_parameters.hpp"

namespace laneloom::dds {
namespace {

using Verdict = SubmessageCheck::Verdict;

constexpr std::uint8_t kAckNack = 0x06, kHeartbeat = 0x07, kGap = 0x08, kInfoSource = 0x0c,
                       kInfoReplyIp4 = 0x0d, kInfoDestination = 0x0e, kInfoReply = 0x0f,
                       kNackFragments = 0x12, kHeartbeatFragments = 0x13, kData = 0x15, kDataFragments = 0x16,
                       kFirstSecured = 0x30, kEncrypted = kFirstSecured, kLastSecured = 0x34;
// What Fast DDS skips: what Connext sends where it is told to (sessions,
// batches, acknowledgements by applications, virtual heartbeats).
constexpr std::uint8_t kDataSession = 0x14, kAckNackBatch = 0x17, kVirtualHeartbeat = 0x1e;
constexpr std::int64_t kLastSequence = std::int64_t{1} << 40;
constexpr std::uint32_t kMostBits = 256;
// The largest message of laneloom has 12.6 MB.
constexpr std::uint32_t kLargestSample_bytes = 16U << 20;
// Fast DDS links the missing fragments of a sample through the memory of the sample itself.
constexpr std::uint32_t kSmallestFragment_bytes = 8;
constexpr std::size_t kEncapsulationBytes = 4;
constexpr std::size_t kInfoSourceBytes = 20;

bool is_sequence(std::int64_t number) { return number >= 1 && number <= kLastSequence; }

/// Takes the size and the words of a set.
Verdict take_bits(RtpsBytes& bytes) {
  const std::uint32_t bits = bytes.u32();
  if (bits > kMostBits) return DatagramRefusal::bitmap;
  bytes.take((std::size_t{bits} + 31) / 32 * 4);
  return bytes.ok() ? Verdict() : DatagramRefusal::length;
}

Verdict ack_nack(const RtpsSubmessage& submessage) {
  RtpsBytes bytes(submessage.body, submessage.little_endian());
  bytes.take(8);
  const std::int64_t base = bytes.sequence();
  // A reader that has heard nothing yet begins with 0.
  if (base != 0 && !is_sequence(base)) return DatagramRefusal::sequence;
  if (const auto refusal = take_bits(bytes)) return refusal;
  bytes.take(4);
  return bytes.ok() ? Verdict() : DatagramRefusal::length;
}

Verdict nack_fragments(const RtpsSubmessage& submessage) {
  RtpsBytes bytes(submessage.body, submessage.little_endian());
  bytes.take(8);
  if (!is_sequence(bytes.sequence())) return DatagramRefusal::sequence;
  const std::uint32_t base = bytes.u32();
  if (base == 0 || base > kLargestSample_bytes / kSmallestFragment_bytes) return DatagramRefusal::fragments;
  if (const auto refusal = take_bits(bytes)) return refusal;
  bytes.take(4);
  return bytes.ok() ? Verdict() : DatagramRefusal::length;
}

/// Fast DDS decrypts as many bytes as the submessage says that it has.
Verdict encrypted(const RtpsSubmessage& submessage) {
  RtpsBytes bytes(submessage.body, false);
  const std::uint32_t length = bytes.u32();
  return bytes.ok() && length <= bytes.left() ? Verdict() : DatagramRefusal::length;
}

Verdict at_least(const RtpsSubmessage& submessage, std::size_t bytes) {
  return submessage.body.size() >= bytes ? Verdict() : DatagramRefusal::length;
}

/// The fragments of one submessage.
struct Fragments {
  std::uint32_t first = 0, count = 0;
  Fragmentation cut;

  bool are_sound() const {
    if (cut.sample_bytes == 0 || cut.sample_bytes > kLargestSample_bytes) return false;
    if (cut.fragment_bytes < kSmallestFragment_bytes || first == 0 || count == 0) return false;
    const std::uint32_t last_at = (cut.fragments() - 1) * cut.fragment_bytes;
    const bool links_fit = (last_at + 3) / 4 * 4 < (cut.sample_bytes + 3) / 4 * 4;
    return links_fit && first <= cut.fragments() && count <= cut.fragments() - first + 1;
  }
  std::uint32_t bytes() const {
    const std::uint32_t at = (first - 1) * cut.fragment_bytes;
    return std::min(count * cut.fragment_bytes, cut.sample_bytes - at);
  }
};

/// Takes what stands between the fixed fields and the payload. `to_qos` is what the submessage says of the
/// fields' length, `least` what they have.
Verdict take_qos(RtpsBytes& bytes, const RtpsSubmessage& submessage, std::size_t to_qos, std::size_t least) {
  // Fast DDS reads the length with a sign, and does not expect less than the fields have.
  if (to_qos < least || to_qos > 0x7fff) return DatagramRefusal::length;
  bytes.take(to_qos - least);
  if (!bytes.ok()) return DatagramRefusal::length;
  if (submessage.has_flag(1) && !take_parameters(bytes, submessage.little_endian()))
    return DatagramRefusal::parameters;
  return {};
}

}  // namespace

SubmessageCheck::SubmessageCheck(const HeardWriters& heard, FragmentedAnnouncements& announcements,
                                 std::span<const std::uint8_t, kPrefixBytes> prefix, std::int64_t now_ns)
    : heard_(heard), announcements_(announcements), now_ns_(now_ns) {
  std::ranges::copy(prefix, source_.begin());
}

Verdict SubmessageCheck::check(const RtpsSubmessage& submessage) {
  if (submessage.kind == kEncrypted) return encrypted(submessage);
  if (submessage.kind > kFirstSecured && submessage.kind <= kLastSecured) return {};
  if (submessage.kind >= kAckNackBatch && submessage.kind <= kVirtualHeartbeat) return {};
  switch (submessage.kind) {
    case kPad:
    case kDataSession:
    case kInfoReply:
    case kInfoReplyIp4:
      return {};
    case kAckNack:
      return ack_nack(submessage);
    case kHeartbeat:
      return heartbeat(submessage);
    case kGap:
      return gap(submessage);
    case kInfoTimestamp:
      return at_least(submessage, submessage.has_flag(1) ? 0 : 8);
    case kInfoSource:
      return info_source(submessage);
    case kInfoDestination:
      return at_least(submessage, kPrefixBytes);
    case kNackFragments:
      return nack_fragments(submessage);
    case kHeartbeatFragments:
      return at_least(submessage, 24);
    case kData:
      return data(submessage);
    case kDataFragments:
      return data_fragments(submessage);
    default:
      return DatagramRefusal::kind;
  }
}

bool SubmessageCheck::may_be_clear(const RtpsSubmessage& submessage) const {
  if (submessage.kind != kData) {
    constexpr std::array kSayNothing{kPad, kInfoTimestamp, kInfoDestination, kInfoSource};
    return submessage.kind >= kFirstSecured ||
           std::ranges::find(kSayNothing, submessage.kind) != kSayNothing.end();
  }
  constexpr std::size_t kWriterAt = 8;
  RtpsBytes bytes(submessage.body, submessage.little_endian());
  bytes.take(kWriterAt);
  const WriterId from = writer(bytes);
  return is_handshake(from) || is_participant(from);
}

void SubmessageCheck::note_all(HeardWriters& heard) const {
  for (const Sent& sent : sent_) {
    heard.note(sent.writer, sent.sequence, now_ns_);
    if (sent.cut) heard.note(sent.writer, *sent.cut, now_ns_);
    if (sent.skipped) heard.note_skipped(sent.writer, *sent.skipped, now_ns_);
  }
}

WriterId SubmessageCheck::writer(RtpsBytes& bytes) const {
  WriterId result = source_;
  std::ranges::copy(bytes.array<4>(), result.begin() + kPrefixBytes);
  return result;
}

Verdict SubmessageCheck::sent(const WriterId& writer, std::int64_t sequence) {
  if (!heard_.may_have_sent(writer, sequence, now_ns_)) return DatagramRefusal::leap;
  sent_.push_back({writer, sequence, {}});
  return {};
}

Verdict SubmessageCheck::data(const RtpsSubmessage& submessage) {
  RtpsBytes bytes(submessage.body, submessage.little_endian());
  bytes.take(2);
  const std::size_t to_qos = bytes.u16();
  bytes.take(4);
  const WriterId from = writer(bytes);
  const std::int64_t sequence = bytes.sequence();
  if (!bytes.ok()) return DatagramRefusal::length;
  if (is_nobody(from)) return DatagramRefusal::writer;
  if (!is_sequence(sequence)) return DatagramRefusal::sequence;
  if (const auto refusal = take_qos(bytes, submessage, to_qos, 16)) return refusal;
  const auto payload = bytes.take(bytes.left());
  const bool has_payload = submessage.has_flag(2) || submessage.has_flag(3);
  if (has_payload && payload.size() < kEncapsulationBytes) return DatagramRefusal::length;
  if (has_payload && is_discovery(from) && !is_sound_announcement(payload))
    return DatagramRefusal::parameters;
  if (has_payload && is_handshake(from) && !is_sound_handshake(payload)) return DatagramRefusal::parameters;
  return sent(from, sequence);
}

Verdict SubmessageCheck::data_fragments(const RtpsSubmessage& submessage) {
  RtpsBytes bytes(submessage.body, submessage.little_endian());
  bytes.take(2);
  const std::size_t to_qos = bytes.u16();
  bytes.take(4);
  const WriterId from = writer(bytes);
  Fragments fragments;
  fragments.cut.sequence = bytes.sequence();
  fragments.first = bytes.u32();
  fragments.count = bytes.u16();
  fragments.cut.fragment_bytes = bytes.u16();
  fragments.cut.sample_bytes = bytes.u32();
  if (!bytes.ok()) return DatagramRefusal::length;
  if (is_nobody(from)) return DatagramRefusal::writer;
  if (!is_sequence(fragments.cut.sequence)) return DatagramRefusal::sequence;
  if (!fragments.are_sound() || !heard_.is_cut_like(from, fragments.cut)) return DatagramRefusal::fragments;
  if (const auto refusal = take_qos(bytes, submessage, to_qos, 28)) return refusal;
  if (bytes.left() < fragments.bytes()) return DatagramRefusal::fragments;
  // Nobody can tell what they will be together. Fast DDS sends a handshake as a whole.
  if (is_handshake(from)) return DatagramRefusal::fragments;
  if (const auto refusal = sent(from, fragments.cut.sequence)) return refusal;
  if (is_discovery(from) &&
      !announcements_.take(from, fragments.cut, fragments.first, bytes.take(fragments.bytes())))
    return DatagramRefusal::parameters;
  sent_.back().cut = fragments.cut;
  return {};
}

Verdict SubmessageCheck::heartbeat(const RtpsSubmessage& submessage) {
  RtpsBytes bytes(submessage.body, submessage.little_endian());
  bytes.take(4);
  const WriterId from = writer(bytes);
  const std::int64_t first = bytes.sequence();
  const std::int64_t last = bytes.sequence();
  bytes.take(4);
  if (!bytes.ok()) return DatagramRefusal::length;
  if (!is_sequence(first) || last < first - 1 || last > kLastSequence) return DatagramRefusal::sequence;
  return sent(from, last);
}

Verdict SubmessageCheck::gap(const RtpsSubmessage& submessage) {
  RtpsBytes bytes(submessage.body, submessage.little_endian());
  bytes.take(4);
  const WriterId from = writer(bytes);
  const std::int64_t start = bytes.sequence();
  const std::int64_t base = bytes.sequence();
  const std::size_t before_bits = bytes.left();
  if (const auto refusal = take_bits(bytes)) return refusal;
  if (!is_sequence(start) || !is_sequence(base) || base < start) return DatagramRefusal::sequence;
  constexpr std::size_t kSizeBytes = 4, kBitsPerByte = 8;
  const auto bits = static_cast<std::int64_t>((before_bits - bytes.left() - kSizeBytes) * kBitsPerByte);
  const SequenceNumbers skipped{start, base + bits};
  if (!heard_.may_skip(from, heard_.newly_skipped(from, skipped) + skipped_by(from), now_ns_))
    return DatagramRefusal::leap;
  if (const auto refusal = sent(from, base)) return refusal;
  sent_.back().skipped = skipped;
  return {};
}

std::int64_t SubmessageCheck::skipped_by(const WriterId& writer) const {
  std::int64_t sum = 0;
  for (const Sent& sent : sent_)
    if (sent.writer == writer && sent.skipped) sum += heard_.newly_skipped(writer, *sent.skipped);
  return sum;
}

Verdict SubmessageCheck::info_source(const RtpsSubmessage& submessage) {
  if (submessage.body.size() != kInfoSourceBytes) return DatagramRefusal::length;
  std::ranges::copy(submessage.body.last(kPrefixBytes), source_.begin());
  return {};
}

}  // namespace laneloom::dds
