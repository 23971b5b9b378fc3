#include "recording/mcap_writer.hpp"

#include <zlib.h>

#include <algorithm>

#include "recording/compression.hpp"

namespace laneloom::recording {
namespace {

std::uint32_t crc_of(ByteView bytes, std::uint32_t before = 0) {
  return static_cast<std::uint32_t>(crc32_z(before, bytes.data(), bytes.size()));
}

void overwrite(Bytes& bytes, std::size_t at, std::uint64_t number) {
  Bytes encoded;
  ByteWriter(encoded).number(number);
  std::copy(encoded.begin(), encoded.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at));
}

/// Appends a record whose content is written by `content(writer)`.
template <class Content>
void append_record(McapOpcode opcode, Bytes& to, Content content) {
  ByteWriter writer(to);
  writer.number(static_cast<std::uint8_t>(opcode));
  const std::size_t length_at = to.size();
  writer.number(std::uint64_t{0});
  content(writer);
  overwrite(to, length_at, to.size() - length_at - sizeof(std::uint64_t));
}

/// Map<uint16, uint64>
void write_map(const std::map<std::uint16_t, std::uint64_t>& map, ByteWriter& writer) {
  writer.number(static_cast<std::uint32_t>(map.size() * (sizeof(std::uint16_t) + sizeof(std::uint64_t))));
  for (const auto& [key, value] : map) {
    writer.number(key);
    writer.number(value);
  }
}

void append_schema(std::uint16_t id, const McapSchema& schema, Bytes& to) {
  append_record(McapOpcode::schema, to, [&](ByteWriter& writer) {
    writer.number(id);
    writer.text(schema.name);
    writer.text(schema.encoding);
    writer.text(schema.data);
  });
}

void append_channel(std::uint16_t id, const McapChannel& channel, Bytes& to) {
  append_record(McapOpcode::channel, to, [&](ByteWriter& writer) {
    writer.number(id);
    writer.number(id);  // a schema of its own
    writer.text(channel.topic);
    writer.text(channel.message_encoding);
    writer.number(std::uint32_t{0});  // no metadata
  });
}

/// Writes the index of a channel; `index` has log times and offsets within the chunk.
void append_message_index(std::uint16_t channel,
                          const std::vector<std::pair<std::uint64_t, std::uint64_t>>& index, Bytes& to) {
  append_record(McapOpcode::message_index, to, [&](ByteWriter& writer) {
    writer.number(channel);
    writer.number(static_cast<std::uint32_t>(index.size() * 2 * sizeof(std::uint64_t)));
    for (const auto& [time_ns, offset] : index) {
      writer.number(time_ns);
      writer.number(offset);
    }
  });
}

}  // namespace

void McapWriter::Times::add(std::uint64_t time_ns) {
  first = std::min(first, time_ns);
  last = std::max(last, time_ns);
}

McapWriter::McapWriter(const std::string& path, Compression compression, std::size_t chunk_bytes)
    : file_(path), compression_(compression), chunk_bytes_(chunk_bytes) {
  Bytes start(kMcapMagic.begin(), kMcapMagic.end());
  append_record(McapOpcode::header, start, [](ByteWriter& writer) {
    writer.text("");  // no profile
    writer.text("laneloom");
  });
  append(start);
}

void McapWriter::append(ByteView data) {
  file_.append(data);
  data_crc_ = crc_of(data, data_crc_);
}

std::uint16_t McapWriter::add_channel(const McapChannel& channel) {
  const auto id = static_cast<std::uint16_t>(message_counts_.size() + 1);
  Bytes schema_record, channel_record;
  append_schema(id, *channel.schema, schema_record);
  append_channel(id, channel, channel_record);
  // Written outside of chunks, so that each chunk can be read even if others are damaged.
  append(schema_record);
  append(channel_record);
  schemas_.insert(schemas_.end(), schema_record.begin(), schema_record.end());
  channels_.insert(channels_.end(), channel_record.begin(), channel_record.end());
  message_counts_[id] = 0;
  return id;
}

void McapWriter::write_metadata(const std::string& name, const McapMetadata& metadata) {
  Bytes texts, record;
  for (const auto& [key, value] : metadata) {
    ByteWriter(texts).text(key);
    ByteWriter(texts).text(value);
  }
  append_record(McapOpcode::metadata, record, [&](ByteWriter& writer) {
    writer.text(name);
    writer.number(static_cast<std::uint32_t>(texts.size()));
    writer.bytes(texts);
  });
  append_record(McapOpcode::metadata_index, metadata_indexes_, [&](ByteWriter& writer) {
    writer.number(file_.size());
    writer.number(std::uint64_t{record.size()});
    writer.text(name);
  });
  append(record);
  ++metadata_count_;
}

void McapWriter::write(std::uint16_t channel, std::uint64_t log_time_ns, std::uint64_t publish_time_ns,
                       std::uint32_t sequence, ByteView message) {
  indexes_[channel].emplace_back(log_time_ns, chunk_.size());
  append_record(McapOpcode::message, chunk_, [&](ByteWriter& writer) {
    writer.number(channel);
    writer.number(sequence);
    writer.number(log_time_ns);
    writer.number(publish_time_ns);
    writer.bytes(message);
  });
  chunk_times_.add(log_time_ns);
  if (chunk_.size() >= chunk_bytes_) flush();
}

void McapWriter::flush() {
  if (chunk_.empty()) return;
  ChunkIndex chunk{.times = chunk_times_, .offset = file_.size(), .uncompressed = chunk_.size()};
  record_.clear();
  append_record(McapOpcode::chunk, record_, [&](ByteWriter& writer) {
    writer.number(chunk_times_.start());
    writer.number(chunk_times_.end());
    writer.number(std::uint64_t{chunk_.size()});
    writer.number(crc_of(chunk_));
    writer.text(name_of(compression_));
    const std::size_t length_at = record_.size();
    writer.number(std::uint64_t{0});
    compress(compression_, chunk_, record_);
    chunk.compressed = record_.size() - length_at - sizeof(std::uint64_t);
    overwrite(record_, length_at, chunk.compressed);
  });
  chunk.length = record_.size();
  append_message_indexes(chunk);
  append(record_);

  for (const auto& [channel, index] : indexes_) message_counts_[channel] += index.size();
  times_.add(chunk_times_.first);
  times_.add(chunk_times_.last);
  chunks_.push_back(std::move(chunk));
  indexes_.clear();
  chunk_.clear();
  chunk_times_ = {};
}

void McapWriter::append_message_indexes(ChunkIndex& chunk) {
  for (const auto& [channel, index] : indexes_) {
    chunk.index_offsets[channel] = chunk.offset + record_.size();
    append_message_index(channel, index, record_);
  }
  chunk.index_length = record_.size() - chunk.length;
}

void McapWriter::write_chunk_index(const ChunkIndex& chunk, Bytes& to) const {
  append_record(McapOpcode::chunk_index, to, [&](ByteWriter& writer) {
    writer.number(chunk.times.start());
    writer.number(chunk.times.end());
    writer.number(chunk.offset);
    writer.number(chunk.length);
    write_map(chunk.index_offsets, writer);
    writer.number(chunk.index_length);
    writer.text(name_of(compression_));
    writer.number(chunk.compressed);
    writer.number(chunk.uncompressed);
  });
}

void McapWriter::write_statistics(Bytes& to) const {
  std::uint64_t messages = 0;
  for (const auto& [channel, count] : message_counts_) messages += count;
  append_record(McapOpcode::statistics, to, [&](ByteWriter& writer) {
    writer.number(messages);
    writer.number(static_cast<std::uint16_t>(message_counts_.size()));  // schemas
    writer.number(static_cast<std::uint32_t>(message_counts_.size()));  // channels
    writer.number(std::uint32_t{0});                                    // attachments
    writer.number(metadata_count_);
    writer.number(static_cast<std::uint32_t>(chunks_.size()));
    writer.number(times_.start());
    writer.number(times_.end());
    write_map(message_counts_, writer);
  });
}

void McapWriter::write_summary(std::uint64_t start, Bytes& to) const {
  const std::size_t before = to.size();
  Bytes offsets;
  const auto add_group = [&](McapOpcode opcode, auto write_group) {
    const std::size_t group_start = to.size();
    write_group();
    if (to.size() == group_start) return;
    append_record(McapOpcode::summary_offset, offsets, [&](ByteWriter& writer) {
      writer.number(static_cast<std::uint8_t>(opcode));
      writer.number(start + (group_start - before));
      writer.number(std::uint64_t{to.size() - group_start});
    });
  };
  ByteWriter writer(to);
  add_group(McapOpcode::schema, [&] { writer.bytes(schemas_); });
  add_group(McapOpcode::channel, [&] { writer.bytes(channels_); });
  add_group(McapOpcode::statistics, [&] { write_statistics(to); });
  add_group(McapOpcode::chunk_index, [&] {
    for (const ChunkIndex& chunk : chunks_) write_chunk_index(chunk, to);
  });
  add_group(McapOpcode::metadata_index, [&] { writer.bytes(metadata_indexes_); });
  const std::uint64_t offsets_start = start + (to.size() - before);
  writer.bytes(offsets);
  writer.number(static_cast<std::uint8_t>(McapOpcode::footer));
  writer.number(std::uint64_t{kMcapFooterBytes});
  writer.number(start);
  writer.number(offsets_start);
  writer.number(crc_of(ByteView(to).subspan(before)));
}

void McapWriter::close() {
  flush();
  Bytes end;
  append_record(McapOpcode::data_end, end, [&](ByteWriter& writer) { writer.number(data_crc_); });
  write_summary(file_.size() + end.size(), end);
  ByteWriter(end).bytes(kMcapMagic);
  file_.append(end);
}

}  // namespace laneloom::recording
