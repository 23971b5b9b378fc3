#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "laneloom/dds/participant.hpp"

/// Writers that every participant has, by the entity in their ids.
namespace laneloom::dds {

/// Whether a writer announces participants or endpoints, in lists of parameters.
inline bool is_discovery(const WriterId& writer) {
  const bool open = writer[12] == 0, secured = writer[12] == 0xff;
  const bool participants = writer[13] <= 1 && writer[14] <= 1;
  const bool endpoints = writer[13] == 0 && writer[14] >= 2 && writer[14] <= 4;
  return (open || secured) && (participants || endpoints) && (writer[15] == 0xc2 || writer[15] == 0xc3);
}

/// Whether there is no such writer. In Fast DDS, the reader of handshakes trusts nobody's samples.
inline bool is_nobody(const WriterId& writer) {
  return std::ranges::all_of(std::span(writer).last<4>(), [](std::uint8_t byte) { return byte == 0; });
}

/// Whether a writer announces participants, so that they can shake hands.
inline bool is_participant(const WriterId& writer) {
  return std::ranges::equal(std::span(writer).last<4>(), std::array<std::uint8_t, 4>{0x00, 0x01, 0x00, 0xc2});
}

/// Whether a writer shakes hands, before there are keys: all that a stranger can say to a secured
/// participant.
inline bool is_handshake(const WriterId& writer) {
  return std::ranges::equal(std::span(writer).last<4>(), std::array<std::uint8_t, 4>{0x00, 0x02, 0x01, 0xc3});
}

}  // namespace laneloom::dds
