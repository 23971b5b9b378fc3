#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// Values as MCAP serialises them: little endian, with the length in bytes before texts and lists.
namespace laneloom::recording {

using Bytes = std::vector<std::uint8_t>;
using ByteView = std::span<const std::uint8_t>;

/// Appends values to a buffer.
class ByteWriter {
 public:
  explicit ByteWriter(Bytes& to) : to_(to) {}

  template <std::unsigned_integral Number>
  void number(Number value) {
    for (std::size_t i = 0; i < sizeof(Number); ++i) {
      to_.push_back(static_cast<std::uint8_t>(std::uint64_t{value} >> 8 * i));
    }
  }
  void bytes(ByteView value) { to_.insert(to_.end(), value.begin(), value.end()); }
  void text(std::string_view value) {
    number(static_cast<std::uint32_t>(value.size()));
    to_.insert(to_.end(), value.begin(), value.end());
  }

 private:
  Bytes& to_;
};

/// Takes values off the front of a buffer. Throws std::runtime_error when it is too short for one.
class ByteReader {
 public:
  explicit ByteReader(ByteView from) : from_(from) {}

  template <std::unsigned_integral Number>
  Number number() {
    std::uint64_t value = 0;
    const ByteView encoded = bytes(sizeof(Number));
    for (std::size_t i = 0; i < sizeof(Number); ++i) value |= std::uint64_t{encoded[i]} << 8 * i;
    return static_cast<Number>(value);
  }
  /// Takes `size` bytes, as a view of the buffer.
  ByteView bytes(std::uint64_t size) {
    if (size > from_.size()) throw std::runtime_error("a length exceeds what is there");
    const ByteView value = from_.first(size);
    from_ = from_.subspan(size);
    return value;
  }
  std::string text() {
    const ByteView value = bytes(number<std::uint32_t>());
    return {value.begin(), value.end()};
  }
  std::size_t remaining() const { return from_.size(); }

 private:
  ByteView from_;
};

}  // namespace laneloom::recording
