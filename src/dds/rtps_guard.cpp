#include "dds/rtps_guard.hpp"

#include <algorithm>

#include "dds/rtps_submessage.hpp"

namespace laneloom::dds {
namespace {

constexpr std::size_t kHeaderBytes = 20, kSubmessageHeaderBytes = 4, kPrefixAt = 8;
constexpr std::size_t kVendorAt = 6;
constexpr std::uint8_t kFirstOfVendors = 0x80;
constexpr std::array<std::uint8_t, 2> kVendorOfFastDds{0x01, 0x0f};

bool is_rtps(std::span<const std::uint8_t> datagram) {
  return datagram.size() >= kHeaderBytes && datagram[0] == 'R' && datagram[1] == 'T' && datagram[2] == 'P' &&
         datagram[3] == 'S' && datagram[4] == 2;
}

/// Cuts a submessage off the front. Nothing: it is longer than what is left.
std::optional<RtpsSubmessage> next(std::span<const std::uint8_t>& rest) {
  if (rest.size() < kSubmessageHeaderBytes) return std::nullopt;
  RtpsSubmessage result{.kind = rest[0], .flags = rest[1], .body = {}};
  RtpsBytes header(rest.subspan(2, 2), result.little_endian());
  std::size_t length = header.u16();
  rest = rest.subspan(kSubmessageHeaderBytes);
  // A length of 0 runs to the end; these two may be empty instead.
  if (length == 0 && result.kind != kPad && result.kind != kInfoTimestamp) length = rest.size();
  if (length > rest.size()) return std::nullopt;
  result.body = rest.first(length);
  const std::size_t padded = (length + 3) / 4 * 4;
  // Fast DDS takes a submessage of a vendor for the last one if its bytes alone end the datagram.
  result.ends_datagram = length == rest.size();
  rest = rest.subspan(padded < rest.size() ? padded : rest.size());
  return result;
}

}  // namespace

std::optional<DatagramRefusal> RtpsGuard::check(std::span<const std::uint8_t> datagram, std::int64_t now_ns) {
  if (!is_rtps(datagram)) return DatagramRefusal::header;
  const bool of_fast_dds = std::ranges::equal(datagram.subspan(kVendorAt, 2), kVendorOfFastDds);
  SubmessageCheck submessages(heard_, announcements_, datagram.subspan(kPrefixAt).first<kPrefixBytes>(),
                              now_ns);
  bool is_protected = false;  // as a whole: what follows is encrypted, or signed
  for (auto rest = datagram.subspan(kHeaderBytes); !rest.empty();) {
    const auto submessage = next(rest);
    if (!submessage) return DatagramRefusal::length;
    if (submessage->kind >= kFirstOfVendors) {
      // It asserts that its own one is the last, and skips those of others.
      if (of_fast_dds && !submessage->ends_datagram) return DatagramRefusal::vendor;
    } else if (wants_protection_ && !is_protected && !submessages.may_be_clear(*submessage)) {
      return DatagramRefusal::clear;
    } else if (const auto refusal = submessages.check(*submessage)) {
      return refusal;
    }
    is_protected |= submessage->kind == kProtectedMessage;
  }
  submessages.note_all(heard_);
  return std::nullopt;
}

}  // namespace laneloom::dds
