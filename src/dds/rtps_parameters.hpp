#pragma once

#include <cstdint>
#include <span>

#include "dds/rtps_bytes.hpp"

namespace laneloom::dds {

/// Takes a list of parameters. False: it does not end, or a parameter is not as long as what it holds.
bool take_parameters(RtpsBytes& bytes, bool little_endian);

/// Whether the payload of a discovery writer is sound. A payload that is no list of parameters is: Fast DDS
/// refuses it by itself.
bool is_sound_announcement(std::span<const std::uint8_t> payload);

/// Whether the payload of a handshake of DDS-Security is sound.
bool is_sound_handshake(std::span<const std::uint8_t> payload);

}  // namespace laneloom::dds
