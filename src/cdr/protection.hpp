#pragma once

#include <cstdint>
#include <span>
#include <string_view>

/// Protection of serialised messages from end to end, after AUTOSAR's E2E profile 7: a CRC-64/XZ over all
/// bytes behind it, which hold a data id, session and sequence number. idl/Common.idl says where they lie.
namespace laneloom::dds {

/// Writes data id and CRC into `message`, which is plain CDR behind its encapsulation and begins with a
/// Header.
void protect(std::span<std::uint8_t> message, std::uint32_t data_id);

/// The reason why `message` differs from what its writer protected: "crc" or "data_id". Empty: it does not
/// differ, or its writer did not protect it. A message that is too short for a header is not judged here.
std::string_view check_protection(std::span<const std::uint8_t> message, std::uint32_t data_id);

}  // namespace laneloom::dds
