#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace laneloom::dds {

/// CRC-64/XZ, eight bytes at a time (slicing by 8). Boost's, byte by byte, took 20 % of the time of a map.
class Crc64 {
 public:
  void add(std::span<const std::uint8_t> bytes) {
    for (; bytes.size() >= kSlices; bytes = bytes.subspan(kSlices)) {
      state_ ^= word(bytes.data());
      const auto slice = [&](std::size_t i) { return kTables[kSlices - 1 - i][state_ >> 8 * i & 0xFF]; };
      state_ = slice(0) ^ slice(1) ^ slice(2) ^ slice(3) ^ slice(4) ^ slice(5) ^ slice(6) ^ slice(7);
    }
    for (const std::uint8_t byte : bytes) state_ = kTables[0][(state_ ^ byte) & 0xFF] ^ state_ >> 8;
  }
  std::uint64_t value() const { return ~state_; }

 private:
  static constexpr std::size_t kSlices = 8;
  static constexpr std::uint64_t kPolynomial = 0xC96C5795D7870F42ULL;  // reflected
  using Table = std::array<std::uint64_t, 256>;

  /// Eight bytes, the first one lowest. The compiler makes one instruction of it.
  static std::uint64_t word(const std::uint8_t* bytes) {
    const auto byte = [&](int i) { return std::uint64_t{bytes[i]} << 8 * i; };
    return byte(0) | byte(1) | byte(2) | byte(3) | byte(4) | byte(5) | byte(6) | byte(7);
  }

  /// The CRCs of single bytes, followed by 0 to 7 zero bytes.
  static constexpr std::array<Table, kSlices> tables() {
    std::array<Table, kSlices> tables{};
    for (std::size_t byte = 0; byte < 256; ++byte) {
      std::uint64_t crc = byte;
      for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ ((crc & 1) != 0 ? kPolynomial : 0);
      tables[0][byte] = crc;
    }
    for (std::size_t slice = 1; slice < kSlices; ++slice)
      for (std::size_t byte = 0; byte < 256; ++byte)
        tables[slice][byte] = tables[0][tables[slice - 1][byte] & 0xFF] ^ tables[slice - 1][byte] >> 8;
    return tables;
  }
  static const std::array<Table, kSlices> kTables;

  std::uint64_t state_ = ~0ULL;
};

inline constexpr std::array<Crc64::Table, Crc64::kSlices> Crc64::kTables = Crc64::tables();

}  // namespace laneloom::dds
