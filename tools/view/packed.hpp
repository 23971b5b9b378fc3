#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "recording/compression.hpp"

namespace laneloom::view {

/// A compressed text.
class Packed {
 public:
  explicit Packed(std::string_view text) : size_(text.size()) {
    recording::compress(recording::Compression::zstd,
                        {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, bytes_);
    bytes_.shrink_to_fit();
  }

  std::string unpacked() const {
    std::string text(size_, '\0');
    recording::decompress(recording::Compression::zstd, bytes_,
                          {reinterpret_cast<std::uint8_t*>(text.data()), text.size()});
    return text;
  }
  std::size_t bytes() const { return bytes_.size(); }

 private:
  std::vector<std::uint8_t> bytes_;
  std::size_t size_;
};

}  // namespace laneloom::view
