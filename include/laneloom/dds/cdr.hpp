#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Messages as bytes, exactly as they go over the wire: plain CDR behind its encapsulation header. T is
/// DetectionFrame, VehiclePose, TrackedObjects, NextTurn, PublishedMap, RoadMarkings or ServiceStatus.
namespace laneloom::dds {

/// Writes `from` as bytes to `to`. Returns how many elements were left out because they exceed the bounds of
/// the IDL, or refer to an element that does. `map_frame_id` is the frame that poses are in.
template <class T>
std::size_t to_cdr(const T& from, const std::string& map_frame_id, std::vector<std::uint8_t>& to);

/// Reads `to` from bytes. Returns why the bytes are refused, by the names that ReaderCallbacks::refused
/// lists; empty: they are valid, and `to` is set.
template <class T>
std::string_view from_cdr(std::span<const std::uint8_t> from, const std::string& map_frame_id, T& to);

/// The beginning of every message.
struct CdrHeader {
  std::int64_t stamp_ns = 0;     ///< sensor clock
  std::uint64_t sequence = 0;    ///< counts up by one per message
  std::uint64_t session_id = 0;  ///< of the writer's run; another value means that it was restarted
};

/// Reads the header of a message. Empty: the bytes are too short, or are not plain CDR. The bytes behind the
/// header are not checked.
std::optional<CdrHeader> header_of(std::span<const std::uint8_t> message);

/// The frame that a pose is in. Empty: it names none, or the bytes are refused.
std::string frame_of_pose(std::span<const std::uint8_t> pose);

}  // namespace laneloom::dds
