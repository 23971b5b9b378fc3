#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "recording/files.hpp"
#include "recording/mcap_format.hpp"
#include "recording/recording.hpp"

namespace laneloom::recording {

/// Writes an indexed MCAP file, chunk by chunk. Not thread-safe. All throw std::runtime_error naming the
/// file, which then ends with the last record that was whole, and stays readable.
class McapWriter {
 public:
  /// The file must not exist yet.
  McapWriter(const std::string& path, Compression compression, std::size_t chunk_bytes);

  /// Adds a channel, which must have a schema, and returns its number. Must be called before any message is
  /// written.
  std::uint16_t add_channel(const McapChannel& channel);
  /// Writes metadata under a name. Must be called before any message is written.
  void write_metadata(const std::string& name, const McapMetadata& metadata);
  void write(std::uint16_t channel, std::uint64_t log_time_ns, std::uint64_t publish_time_ns,
             std::uint32_t sequence, ByteView message);
  /// Ends the chunk, so that all messages written so far are on disk.
  void flush();
  /// Writes the index and the file's end; nothing may be written after it. Without it, the file counts as cut
  /// off.
  void close();

  const std::string& path() const { return file_.path(); }
  /// Size in bytes, on disk and not yet on disk.
  std::uint64_t size() const { return file_.size() + chunk_.size(); }

 private:
  /// The first and last log time of messages. While `first` > `last` there is none yet.
  struct Times {
    std::uint64_t first = ~std::uint64_t{0};
    std::uint64_t last = 0;
    void add(std::uint64_t time_ns);
    std::uint64_t start() const { return first > last ? 0 : first; }
    std::uint64_t end() const { return first > last ? 0 : last; }
  };
  /// The place of a chunk and its message indexes in the file.
  struct ChunkIndex {
    Times times;
    std::uint64_t offset = 0, length = 0, index_length = 0, compressed = 0, uncompressed = 0;
    std::map<std::uint16_t, std::uint64_t> index_offsets;  ///< by channel
  };
  /// The messages of one channel in one chunk: log time, offset within the chunk.
  using MessageIndex = std::vector<std::pair<std::uint64_t, std::uint64_t>>;

  void append(ByteView data);
  void append_message_indexes(ChunkIndex& chunk);
  void write_chunk_index(const ChunkIndex& chunk, Bytes& to) const;
  void write_statistics(Bytes& to) const;
  /// Writes the part of the file behind the data section, without the magic. `start` is its offset in the
  /// file.
  void write_summary(std::uint64_t start, Bytes& to) const;

  OutputFile file_;
  Compression compression_;
  std::size_t chunk_bytes_;
  Bytes chunk_;
  Bytes record_;  // kept, so that its memory is reused
  Times chunk_times_, times_;
  std::map<std::uint16_t, MessageIndex> indexes_;
  std::vector<ChunkIndex> chunks_;
  Bytes schemas_, channels_, metadata_indexes_;  // records, for the summary
  std::uint32_t metadata_count_ = 0;
  std::map<std::uint16_t, std::uint64_t> message_counts_;
  std::uint32_t data_crc_ = 0;
};

}  // namespace laneloom::recording
