#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Messages as bytes, exactly as they go over the wire: plain CDR behind its encapsulation header.
/// T is DetectionFrame, VehiclePose, PublishedMap, RoadMarkings or ServiceStatus.
namespace laneloom::dds {

/// Returns how many elements were left out, because they exceed the bounds of the IDL or refer to what does.
/// `map_frame_id` is the frame that poses are in.
template <class T>
std::size_t to_cdr(const T& from, const std::string& map_frame_id, std::vector<std::uint8_t>& to);

/// Why the bytes are refused, by the names that a Reader uses; empty: they are not, and `to` is set.
template <class T>
std::string_view from_cdr(std::span<const std::uint8_t> from, const std::string& map_frame_id, T& to);

/// What every message begins with.
struct CdrHeader {
  std::int64_t stamp_ns = 0;
  std::uint64_t sequence = 0;
  std::uint64_t session_id = 0;
};

/// None: the bytes are too short, or no plain CDR. Whether the rest is well formed is not looked at.
std::optional<CdrHeader> header_of(std::span<const std::uint8_t> message);

}  // namespace laneloom::dds
