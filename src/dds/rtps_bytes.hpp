#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace laneloom::dds {

/// Reads the bytes of strangers from front to back. A read beyond the end gives zeros, and is remembered.
class RtpsBytes {
 public:
  RtpsBytes(std::span<const std::uint8_t> bytes, bool little_endian)
      : bytes_(bytes), little_endian_(little_endian) {}

  bool ok() const { return ok_; }
  std::size_t left() const { return bytes_.size(); }

  /// The next `count` bytes; none if there are fewer.
  std::span<const std::uint8_t> take(std::size_t count) {
    if (count > bytes_.size()) {
      ok_ = false;
      bytes_ = {};
      return {};
    }
    const auto taken = bytes_.first(count);
    bytes_ = bytes_.subspan(count);
    return taken;
  }
  template <std::size_t count>
  std::array<std::uint8_t, count> array() {
    std::array<std::uint8_t, count> result{};
    const auto bytes = take(count);
    for (std::size_t i = 0; i < bytes.size(); ++i) result[i] = bytes[i];
    return result;
  }
  std::uint16_t u16() { return static_cast<std::uint16_t>(number<2>()); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(number<4>()); }
  /// A sequence number: its upper half, which has a sign, comes first.
  std::int64_t sequence() {
    const auto high = static_cast<std::int32_t>(u32());
    return static_cast<std::int64_t>(high) * (std::int64_t{1} << 32) + u32();
  }

 private:
  template <std::size_t count>
  std::uint64_t number() {
    const auto bytes = array<count>();
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < count; ++i)
      value = value << 8U | (little_endian_ ? bytes[count - 1 - i] : bytes[i]);
    return value;
  }

  std::span<const std::uint8_t> bytes_;
  bool little_endian_;
  bool ok_ = true;
};

}  // namespace laneloom::dds
