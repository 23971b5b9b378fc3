#include "recording/compression.hpp"

#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>

namespace laneloom::recording {
namespace {

constexpr int kZstdLevel = 1;

void compress_zstd(ByteView from, Bytes& to) {
  const std::size_t before = to.size();
  to.resize(before + ZSTD_compressBound(from.size()));
  const std::size_t size =
      ZSTD_compress(to.data() + before, to.size() - before, from.data(), from.size(), kZstdLevel);
  if (ZSTD_isError(size) != 0U) throw std::runtime_error(std::string("zstd: ") + ZSTD_getErrorName(size));
  to.resize(before + size);
}

void compress_lz4(ByteView from, Bytes& to) {
  const std::size_t before = to.size();
  to.resize(before + LZ4F_compressFrameBound(from.size(), nullptr));
  const std::size_t size =
      LZ4F_compressFrame(to.data() + before, to.size() - before, from.data(), from.size(), nullptr);
  if (LZ4F_isError(size) != 0U) throw std::runtime_error(std::string("lz4: ") + LZ4F_getErrorName(size));
  to.resize(before + size);
}

[[noreturn]] void refuse_size() { throw std::runtime_error("the compressed size of a chunk does not fit"); }

void decompress_zstd(ByteView from, std::span<std::uint8_t> to) {
  const std::size_t size = ZSTD_decompress(to.data(), to.size(), from.data(), from.size());
  if (ZSTD_isError(size) != 0U) throw std::runtime_error(std::string("zstd: ") + ZSTD_getErrorName(size));
  if (size != to.size()) refuse_size();
}

void decompress_lz4(ByteView from, std::span<std::uint8_t> to) {
  LZ4F_dctx* created = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&created, LZ4F_VERSION)) != 0U) throw std::bad_alloc();
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> context(
      created, LZ4F_freeDecompressionContext);
  std::size_t expected = 1;  // not 0: more input is expected; 0: the frame ends
  while (expected != 0) {
    std::size_t written = to.size();
    std::size_t read = from.size();
    expected = LZ4F_decompress(context.get(), to.data(), &written, from.data(), &read, nullptr);
    if (LZ4F_isError(expected) != 0U)
      throw std::runtime_error(std::string("lz4: ") + LZ4F_getErrorName(expected));
    to = to.subspan(written);
    from = from.subspan(read);
    if (expected != 0 && written == 0 && read == 0) refuse_size();
  }
  if (!from.empty() || !to.empty()) refuse_size();
}

}  // namespace

std::string_view name_of(Compression compression) {
  switch (compression) {
    case Compression::none:
      return "";
    case Compression::lz4:
      return "lz4";
    case Compression::zstd:
      return "zstd";
  }
  return "";
}

Compression compression_of(std::string_view mcap_name) {
  for (const auto compression : {Compression::none, Compression::lz4, Compression::zstd}) {
    if (name_of(compression) == mcap_name) return compression;
  }
  throw std::runtime_error("unknown compression \"" + std::string(mcap_name) + "\"; lz4 and zstd are known");
}

void compress(Compression compression, ByteView from, Bytes& to) {
  switch (compression) {
    case Compression::none:
      to.insert(to.end(), from.begin(), from.end());
      return;
    case Compression::lz4:
      return compress_lz4(from, to);
    case Compression::zstd:
      return compress_zstd(from, to);
  }
}

void decompress(Compression compression, ByteView from, std::span<std::uint8_t> to) {
  switch (compression) {
    case Compression::none:
      if (from.size() != to.size()) refuse_size();
      std::copy(from.begin(), from.end(), to.begin());
      return;
    case Compression::lz4:
      return decompress_lz4(from, to);
    case Compression::zstd:
      return decompress_zstd(from, to);
  }
}

}  // namespace laneloom::recording
