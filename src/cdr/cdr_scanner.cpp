#include "cdr/cdr_scanner.hpp"

#include <algorithm>

namespace laneloom::dds {
namespace {

constexpr std::size_t kEncapsulationBytes = 4;
constexpr std::size_t kMaxPaddingBytes = 3;

}  // namespace

CdrScanner::CdrScanner(std::span<const std::uint8_t> payload) {
  ok_ = payload.size() >= kEncapsulationBytes && payload[0] == 0 && payload[1] <= 1;
  if (!ok_) return;
  little_endian_ = payload[1] == 1;
  bytes_ = payload.subspan(kEncapsulationBytes);
}

void CdrScanner::numbers(std::size_t size, std::size_t count) {
  if (!ok_ || count == 0) return;
  const auto aligned = (position_ + size - 1) / size * size;
  ok_ = aligned <= bytes_.size() && count <= (bytes_.size() - aligned) / size;
  if (ok_) position_ = aligned + size * count;
}

std::size_t CdrScanner::length(std::size_t bound) {
  numbers(sizeof(std::uint32_t));
  if (!ok_) return 0;
  std::size_t value = 0;
  for (std::size_t i = 0; i < sizeof(std::uint32_t); ++i) {
    const auto shift = 8 * (little_endian_ ? i : 3 - i);
    value |= std::size_t{bytes_[position_ - 4 + i]} << shift;
  }
  ok_ = value <= bound;
  return ok_ ? value : 0;
}

void CdrScanner::text(std::size_t bound) {
  const auto count = length(bound + 1);  // with the terminator
  numbers(1, count);
  if (!ok_) return;
  // A zero before the terminator would end the text there: "map\0x" would count as "map".
  const auto text = bytes_.subspan(position_ - count, count);
  ok_ = count > 0 && std::ranges::find(text, 0) == text.end() - 1;
}

void CdrScanner::number_sequence(std::size_t size, std::size_t bound) { numbers(size, length(bound)); }

void CdrScanner::double_sequence(std::size_t per_element, std::size_t bound) {
  numbers(sizeof(double), per_element * length(bound));
}

bool CdrScanner::complete() const { return ok_ && bytes_.size() - position_ <= kMaxPaddingBytes; }

}  // namespace laneloom::dds
