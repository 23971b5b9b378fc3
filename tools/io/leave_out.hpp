#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <stdexcept>
#include <string>

#include "base/left_out.hpp"
#include "base/seconds.hpp"

namespace laneloom::io {

/// The reason of elements that are too many or too long for the bounds of the IDL.
inline constexpr const char* kBeyondBounds = "beyond the bounds of a message";

/// Counts what is wrong at a stamp and is left out. Throws std::runtime_error instead if that is strict.
inline void leave_out(LeftOut& left_out, const std::string& what, std::int64_t stamp_ns,
                      std::uint64_t count = 1) {
  const std::string place = fmt::format("stamp {:.3f} s", seconds(stamp_ns));
  if (left_out.strict()) throw std::runtime_error(place + ": " + what);
  left_out.add(what, place, count);
}

}  // namespace laneloom::io
