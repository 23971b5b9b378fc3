#pragma once

#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "dds/rtps_datagrams.hpp"

namespace laneloom::dds {

/// The datagrams in a file of tests/dds/captures, which has whole IP packets. Throws std::runtime_error.
inline std::vector<Packet> captured_datagrams(const std::string& file) {
  constexpr std::size_t kFileHeaderBytes = 24, kPacketHeaderBytes = 16, kSizeAt = 8, kIpAndUdpBytes = 28;
  std::ifstream in(file, std::ios::binary);
  const Packet bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  std::vector<Packet> result;
  for (std::size_t at = kFileHeaderBytes; at + kPacketHeaderBytes <= bytes.size();) {
    std::uint32_t size = 0;
    std::memcpy(&size, &bytes[at + kSizeAt], sizeof size);
    at += kPacketHeaderBytes;
    if (size < kIpAndUdpBytes || size > bytes.size() - at) throw std::runtime_error(file + ": is damaged");
    const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    result.emplace_back(begin + kIpAndUdpBytes, begin + static_cast<std::ptrdiff_t>(size));
    at += size;
  }
  if (result.empty()) throw std::runtime_error(file + ": has no datagrams");
  return result;
}

}  // namespace laneloom::dds
