#pragma once

#include <cstdint>

namespace laneloom {

/// FNV-1a of 64 bits: a number that tells two rows of bytes apart, but by bad luck. It keeps no secrets.
std::uint64_t fnv1a(const auto& bytes) {
  std::uint64_t hash = 14695981039346656037U;
  for (const auto byte : bytes) hash = (hash ^ static_cast<std::uint8_t>(byte)) * 1099511628211U;
  return hash;
}

}  // namespace laneloom
