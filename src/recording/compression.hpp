#pragma once

#include <memory>
#include <string_view>

#include "recording/bytes.hpp"
#include "recording/recording.hpp"

namespace laneloom::recording {

/// The name of a compression in MCAP; empty for none.
std::string_view name_of(Compression compression);

/// The compression of a name in MCAP. For an unknown name it throws std::runtime_error, which lists the known
/// names.
Compression compression_of(std::string_view mcap_name);

/// Appends the compressed bytes of `from` to `to`.
void compress(Compression compression, ByteView from, Bytes& to);

/// Fills `to`, which must have exactly the size of the decompressed bytes. Throws std::runtime_error when
/// `from` is malformed or of another size. Allocates nothing that grows with the input.
void decompress(Compression compression, ByteView from, std::span<std::uint8_t> to);

}  // namespace laneloom::recording
