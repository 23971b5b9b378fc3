#include "cdr/protection.hpp"

#include <array>
#include <cstddef>

#include "cdr/crc64.hpp"

namespace laneloom::dds {
namespace {

constexpr std::size_t kCrcAt = 4;  // behind the encapsulation
constexpr std::size_t kDataIdAt = kCrcAt + sizeof(std::uint64_t);
constexpr std::size_t kBehind = kDataIdAt + sizeof(std::uint32_t);

std::uint64_t crc_of(std::span<const std::uint8_t> message) {
  Crc64 crc;
  crc.add(message.subspan(kDataIdAt));
  // RTPS pads a message to a multiple of four bytes, and does not always tell the reader.
  constexpr std::array<std::uint8_t, 3> kZeros{};
  crc.add(std::span(kZeros).first((4 - message.size() % 4) % 4));
  return crc.value();
}

/// Reads and writes numbers in the byte order that the encapsulation names.
template <class T>
T read(std::span<const std::uint8_t> message, std::size_t at) {
  T value = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    const std::size_t shift = 8 * (message[1] == 1 ? i : sizeof(T) - 1 - i);
    value |= static_cast<T>(T{message[at + i]} << shift);
  }
  return value;
}

template <class T>
void write(T value, std::size_t at, std::span<std::uint8_t> message) {
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    const std::size_t shift = 8 * (message[1] == 1 ? i : sizeof(T) - 1 - i);
    message[at + i] = static_cast<std::uint8_t>(value >> shift);
  }
}

}  // namespace

void protect(std::span<std::uint8_t> message, std::uint32_t data_id) {
  if (message.size() < kBehind) return;
  write(data_id, kDataIdAt, message);
  write(crc_of(message), kCrcAt, message);
}

std::string_view check_protection(std::span<const std::uint8_t> message, std::uint32_t data_id) {
  if (message.size() < kBehind) return {};
  const auto crc = read<std::uint64_t>(message, kCrcAt);
  const auto id = read<std::uint32_t>(message, kDataIdAt);
  if (crc == 0 && id == 0) return {};
  if (crc != crc_of(message)) return "crc";
  return id == data_id ? std::string_view() : "data_id";
}

}  // namespace laneloom::dds
