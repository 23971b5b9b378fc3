#pragma once

#include <memory>
#include <string_view>

#include "recording/bytes.hpp"
#include "recording/recording.hpp"

namespace laneloom {

/// As MCAP names it; empty for none.
std::string_view name_of(Compression compression);

/// Throws std::runtime_error, naming what is known, for any other name.
Compression compression_of(std::string_view mcap_name);

/// Appends the compressed bytes.
void compress(Compression compression, ByteView from, Bytes& to);

/// Fills `to`, which has to be of the very size that the bytes had before. Throws std::runtime_error when
/// `from` is malformed or of another size. Allocates nothing that grows with the input.
void decompress(Compression compression, ByteView from, std::span<std::uint8_t> to);

}  // namespace laneloom
