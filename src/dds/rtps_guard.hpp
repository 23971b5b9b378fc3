#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "dds/heard_writers.hpp"
#include "dds/rtps_announcements.hpp"

namespace laneloom::dds {

/// Why a datagram is not handed to Fast DDS.
enum class DatagramRefusal {
  header,      ///< no RTPS of version 2
  length,      ///< a submessage is longer than its datagram, or shorter than what it holds
  kind,        ///< an unknown submessage
  vendor,      ///< a submessage of Fast DDS' own that does not end its datagram
  clear,       ///< not encrypted or signed, where the governance of DDS-Security wants that
  writer,      ///< a sample of nobody
  fragments,   ///< fragments that do not fit to their sample
  sequence,    ///< sequence numbers that no writer has
  leap,        ///< sequence numbers far beyond those that the writer has sent, or too many skipped ones
  bitmap,      ///< a set of more numbers than RTPS allows
  parameters,  ///< a list of parameters that does not end, or of other lengths than it says
};
inline constexpr std::array<std::string_view, 11> kDatagramRefusals{
    "header",    "length",   "kind", "vendor", "clear",     "writer",
    "fragments", "sequence", "leap", "bitmap", "parameters"};

/// A guard at the door of Fast DDS 2.9, which ends, loops or corrupts its memory over some malformed
/// datagrams. It knows nothing of sockets and clocks. Not thread-safe.
class RtpsGuard {
 public:
  /// `wants_protection`: all messages must be protected by DDS-Security, but for those by which keys are
  /// agreed on.
  explicit RtpsGuard(bool wants_protection = false) : wants_protection_(wants_protection) {}
  bool wants_protection() const { return wants_protection_; }

  /// Why a received datagram is refused; nothing: it may pass. `now_ns` is of a steady clock.
  std::optional<DatagramRefusal> check(std::span<const std::uint8_t> datagram, std::int64_t now_ns);

 private:
  bool wants_protection_;
  HeardWriters heard_;
  FragmentedAnnouncements announcements_;
};

}  // namespace laneloom::dds
