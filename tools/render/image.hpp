#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace laneloom::render {

/// Pixels, row by row: red, green, blue.
struct Image {
  std::size_t width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

}  // namespace laneloom::render
