#include "recording/mcap_section.hpp"

#include <zlib.h>

#include <algorithm>
#include <stdexcept>

#include "recording/compression.hpp"

namespace laneloom::recording {
namespace {

using Buffer = std::unique_ptr<std::uint8_t[]>;  // NOLINT(*-avoid-c-arrays)

/// Takes memory for a section, within the limits.
class Allowance {
 public:
  Allowance(const RecordingLimits& limits, std::uint64_t open_bytes, std::uint64_t& used)
      : limits_(limits), open_bytes_(open_bytes), used_(used) {}

  Buffer buffer(std::uint64_t size) {
    if (size > limits_.max_chunk_bytes)
      throw std::runtime_error("a chunk of " + std::to_string(size) + " bytes; " +
                               std::to_string(limits_.max_chunk_bytes) + " are allowed");
    take(size);
    return std::make_unique_for_overwrite<std::uint8_t[]>(size);  // NOLINT(*-avoid-c-arrays)
  }
  void take(std::uint64_t size) {
    used_ += size;
    if (open_bytes_ + used_ > limits_.max_open_bytes)
      throw std::runtime_error("chunks whose times overlap take more than the " +
                               std::to_string(limits_.max_open_bytes) + " bytes that are allowed");
  }

 private:
  const RecordingLimits& limits_;
  std::uint64_t open_bytes_;
  std::uint64_t& used_;
};

/// The records of a chunk: a view of its content, or of a buffer into which it is decompressed.
ByteView unpack(ByteView content, Allowance& allowance, Buffer& decompressed) {
  ByteReader reader(content);
  reader.bytes(2 * sizeof(std::uint64_t));  // times
  const auto size = reader.number<std::uint64_t>();
  const auto crc = reader.number<std::uint32_t>();
  const Compression compression = compression_of(reader.text());
  ByteView records = reader.bytes(reader.number<std::uint64_t>());
  if (compression == Compression::none) {
    if (size != records.size()) throw std::runtime_error("a chunk of another size than it says");
  } else {
    decompressed = allowance.buffer(size);
    decompress(compression, records, {decompressed.get(), size});
    records = {decompressed.get(), size};
  }
  if (crc != 0 && crc != crc32_z(0, records.data(), records.size()))
    throw std::runtime_error("a chunk is damaged: its CRC is wrong");
  return records;
}

void add_message(ByteView message, const McapSection& section, Allowance& allowance, LoadedSection& to) {
  if (message.size() < kMcapMessageHeaderBytes) throw std::runtime_error("a message that is too short");
  ByteReader reader(message);
  reader.bytes(sizeof(std::uint16_t) + sizeof(std::uint32_t));  // channel, sequence
  const auto time_ns = reader.number<std::uint64_t>();
  if (time_ns < section.start_ns) throw std::runtime_error("a message that is older than its chunk says");
  allowance.take(3 * sizeof(LoadedSection::Entry));  // the most that a vector takes while it grows
  to.entries.push_back({time_ns, message});
}

void list_records(ByteView records, const McapSection& section, Allowance& allowance,
                  McapCatalogue& catalogue, LoadedSection& to) {
  ByteReader reader(records);
  while (reader.remaining() > 0) {
    const McapOpcode opcode{reader.number<std::uint8_t>()};
    const ByteView content = reader.bytes(reader.number<std::uint64_t>());
    if (opcode == McapOpcode::schema) catalogue.add_schema(content);
    if (opcode == McapOpcode::channel) catalogue.add_channel(content);
    if (opcode == McapOpcode::message) add_message(content, section, allowance, to);
  }
}

}  // namespace

LoadedSection load(const InputFile& file, const McapSection& section, const RecordingLimits& limits,
                   std::uint64_t open_bytes, McapCatalogue& catalogue) {
  LoadedSection loaded{.offset = section.offset};
  Allowance allowance(limits, open_bytes, loaded.bytes);
  at_offset(file, section.offset, [&] { loaded.content = allowance.buffer(section.length); });
  const std::span content{loaded.content.get(), section.length};
  file.read(section.offset, content);
  at_offset(file, section.offset, [&] {
    const ByteView records = section.is_chunk ? unpack(content, allowance, loaded.decompressed) : content;
    list_records(records, section, allowance, catalogue, loaded);
  });
  const auto time = &LoadedSection::Entry::log_time_ns;
  if (!std::ranges::is_sorted(loaded.entries, {}, time)) std::ranges::stable_sort(loaded.entries, {}, time);
  return loaded;
}

}  // namespace laneloom::recording
