#include "dds/rtps_parameters.hpp"

#include <cstddef>

namespace laneloom::dds {
namespace {

constexpr std::uint16_t kSentinel = 0x0001;
constexpr std::uint8_t kParametersBigEndian = 0x02, kParametersLittleEndian = 0x03;  // PL_CDR
constexpr std::uint8_t kLittleEndian = 0x01;                                         // CDR
constexpr std::size_t kLocatorBytes = 24;
// The identities of a message and of the one that it answers, a participant and two endpoints.
constexpr std::size_t kHandshakeIdsBytes = 96;
constexpr std::uint32_t kMostTokens = 8;
constexpr std::uint32_t kMostDomains = 0xffff;

bool take_string(RtpsBytes& bytes) {
  const std::size_t length = bytes.u32();
  bytes.take(length);
  const std::size_t padding = (4 - length % 4) % 4;
  bytes.take(padding < bytes.left() ? padding : bytes.left());  // the last string may end without
  return bytes.ok();
}

/// A sequence whose elements have `strings` strings each.
bool take_strings(RtpsBytes& bytes, std::size_t strings) {
  const std::uint64_t count = std::uint64_t{bytes.u32()} * strings;
  if (count * 4 > bytes.left()) return false;
  for (std::uint64_t i = 0; i < count; ++i)
    if (!take_string(bytes)) return false;
  return bytes.ok();
}

/// A token of DDS-Security: its class, properties, and properties of bytes.
bool take_token(RtpsBytes& bytes) {
  return take_string(bytes) && take_strings(bytes, 2) &&
         take_strings(bytes, 2);  // bytes are laid out as strings
}

bool is_sound(std::uint16_t id, RtpsBytes value) {
  switch (id) {
    case 0x0005:  // name of a topic
    case 0x0007:  // name of a type
    case 0x0062:  // name of an entity
    case 0x4014:  // tag of a domain
      return take_string(value);
    case 0x1001:  // token of an identity
    case 0x1002:  // token of permissions
    case 0x1006:  // token of a status of an identity
      return take_token(value);
    case 0x0029:  // partitions
      return take_strings(value, 1);
    case 0x0059:  // properties
      return take_strings(value, 2);
    case 0x002c:  // data of a user, a group, a topic
    case 0x002d:
    case 0x002e:
      return value.u32() <= value.left() && value.ok();
    case 0x0073:  // representations of data
      return value.u32() <= value.left() / 2 && value.ok();
    case 0x8006:  // domains of shared data in Fast DDS, which reads it of any vendor; a number in RTI's
      return value.u32() <= kMostDomains && value.ok();
    case 0x002f:  // locators
    case 0x0030:
    case 0x0031:
    case 0x0032:
    case 0x0033:
    case 0x0048:
      return value.left() == kLocatorBytes;
    default:
      return true;
  }
}

}  // namespace

bool take_parameters(RtpsBytes& bytes, bool little_endian) {
  while (bytes.ok()) {
    const std::uint16_t id = bytes.u16();
    const std::uint16_t length = bytes.u16();
    if (!bytes.ok()) return false;
    if (id == kSentinel) return true;
    const auto value = bytes.take(length);
    if (!bytes.ok() || !is_sound(id, RtpsBytes(value, little_endian))) return false;
    bytes.take((4 - std::size_t{length} % 4) % 4);
  }
  return false;
}

bool is_sound_announcement(std::span<const std::uint8_t> payload) {
  if (payload.size() < 4 || payload[0] != 0) return true;
  if (payload[1] != kParametersBigEndian && payload[1] != kParametersLittleEndian) return true;
  const bool little_endian = payload[1] == kParametersLittleEndian;
  RtpsBytes bytes(payload.subspan(4), little_endian);
  return take_parameters(bytes, little_endian);
}

bool is_sound_handshake(std::span<const std::uint8_t> payload) {
  if (payload.size() < 4 || payload[0] != 0 || payload[1] > kLittleEndian) return false;
  RtpsBytes bytes(payload.subspan(4), payload[1] == kLittleEndian);
  bytes.take(kHandshakeIdsBytes);
  if (!take_string(bytes)) return false;
  const std::uint32_t tokens = bytes.u32();
  if (tokens > kMostTokens) return false;
  for (std::uint32_t i = 0; i < tokens; ++i)
    if (!take_token(bytes)) return false;
  return bytes.ok();
}

}  // namespace laneloom::dds
