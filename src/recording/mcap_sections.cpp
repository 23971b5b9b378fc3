#include "recording/mcap_sections.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "recording/compression.hpp"

namespace laneloom::recording {
namespace {

constexpr std::uint64_t kWindowBytes = 4096;
/// A stretch of messages outside of chunks is cut at this size, so that few of them are in memory at a time.
constexpr std::uint64_t kMaxLooseBytes = 1U << 20U;
constexpr std::size_t kLogTimeOffset = 6;  // in a message
/// The most that comes before the records of a chunk: times, size, CRC, the name of a compression, length.
constexpr std::size_t kChunkHeaderBytes = 3 * 8 + 4 + (4 + 4) + 8;
constexpr std::size_t kMaxDamages = 1000;  // more are not worth memory

struct Record {
  McapOpcode opcode{};
  std::uint64_t offset = 0;  ///< of its content
  std::uint64_t length = 0;  ///< likewise
  std::uint64_t start() const { return offset - kMcapRecordHeaderBytes; }
  std::uint64_t end() const { return offset + length; }
};

class Walk {
 public:
  Walk(const InputFile& file, const RecordingLimits& limits, McapCatalogue& catalogue)
      : file_(file), limits_(limits), catalogue_(catalogue), end_(file.size()) {}

  McapContents contents() {
    std::optional<std::uint64_t> offset = check_magic();
    const std::uint64_t first = *offset;
    while (offset) {
      const std::uint64_t start = *offset;
      try {
        offset = take_at(start, start == first);
      } catch (const Damage& damage) {
        offset = next_chunk(start + 1);
        add(damage);
      }
    }
    return std::move(contents_);
  }

 private:
  [[noreturn]] void fail(std::uint64_t offset, const std::string& what) const {
    at_offset(file_, offset, [&] { throw std::runtime_error(what); });
    throw std::logic_error("not reached");
  }

  /// Takes a record. Returns the offset of the one behind it. None: there is none.
  std::optional<std::uint64_t> take_at(std::uint64_t offset, bool is_first) {
    const auto record = record_at(offset);
    if (!record) {
      if (!contents_.cut_off) fail(offset, "there is no footer");
      if (next_chunk(offset + 1)) fail(offset, "a record that is longer than the file, or none");
      return std::nullopt;
    }
    if (is_first != (record->opcode == McapOpcode::header)) fail(offset, "a header is expected at the start");
    if (record->opcode == McapOpcode::footer) {
      if (!contents_.cut_off && record->end() != end_) fail(offset, "a footer that is not at the end");
      return std::nullopt;
    }
    // With a wrong length, what comes behind is no record, and other chunks may be lost with this one.
    if (record->opcode == McapOpcode::chunk && !is_chunk(offset) && next_chunk(offset + 1))
      fail(offset, "a chunk of another length than it says");
    try {
      at_offset(file_, offset, [&] { take(*record); });
    } catch (const Damage& damage) {
      add(damage);
    }
    return record->end();
  }

  void add(const Damage& damage) {
    if (contents_.damages.size() < kMaxDamages) contents_.damages.push_back(damage);
  }

  /// The offset of the next chunk, told by its header. None: no other follows.
  std::optional<std::uint64_t> next_chunk(std::uint64_t offset) {
    offset = std::max(offset, next_chunk_);  // what was searched already is not searched again
    for (; offset < end_; ++offset)
      if (window(offset, 1)[0] == static_cast<std::uint8_t>(McapOpcode::chunk) && is_chunk(offset)) break;
    next_chunk_ = std::min(offset, end_);
    return next_chunk_ < end_ ? std::optional(next_chunk_) : std::nullopt;
  }

  bool is_chunk(std::uint64_t offset) try {
    if (end_ - offset < kMcapRecordHeaderBytes + kChunkHeaderBytes) return false;
    ByteReader reader(window(offset, kMcapRecordHeaderBytes + kChunkHeaderBytes));
    reader.number<std::uint8_t>();
    const auto length = reader.number<std::uint64_t>();
    const auto start_ns = reader.number<std::uint64_t>(), end_ns = reader.number<std::uint64_t>();
    reader.bytes(sizeof(std::uint64_t) + sizeof(std::uint32_t));  // size and CRC
    compression_of(reader.text());
    const auto records = reader.number<std::uint64_t>();
    const std::uint64_t header = kChunkHeaderBytes - reader.remaining();
    return start_ns <= end_ns && length <= end_ - offset - kMcapRecordHeaderBytes && records <= length &&
           records + header == length;
  } catch (const std::runtime_error&) {
    return false;
  }

  /// Returns the offset of the first record.
  std::uint64_t check_magic() {
    const auto is_magic = [&](std::uint64_t offset) {
      return std::ranges::equal(window(offset, kMcapMagic.size()), kMcapMagic);
    };
    if (file_.size() < kMcapMagic.size() || !is_magic(0)) fail(0, "this is no MCAP file");
    contents_.cut_off = file_.size() < 2 * kMcapMagic.size() || !is_magic(file_.size() - kMcapMagic.size());
    if (!contents_.cut_off) end_ -= kMcapMagic.size();
    return kMcapMagic.size();
  }

  /// The next record. None: the file ends here, or is cut off.
  std::optional<Record> record_at(std::uint64_t offset) {
    if (offset == end_) return std::nullopt;
    if (end_ - offset >= kMcapRecordHeaderBytes) {
      ByteReader reader(window(offset, kMcapRecordHeaderBytes));
      const auto opcode = reader.number<std::uint8_t>();
      const Record record{McapOpcode{opcode}, offset + kMcapRecordHeaderBytes,
                          reader.number<std::uint64_t>()};
      // A file system may leave zeros for an end that did not get to disk.
      if (opcode != 0 && record.length <= end_ - record.offset) return record;
    }
    if (!contents_.cut_off) fail(offset, "a record that is longer than the file, or none");
    return std::nullopt;
  }

  void take(const Record& record) {
    switch (record.opcode) {
      case McapOpcode::schema:
        return catalogue_.add_schema(content(record));
      case McapOpcode::channel:
        contents_.has_summary = contents_.has_summary || data_ended_;
        return catalogue_.add_channel(content(record));
      case McapOpcode::message:
        return add_message(record);
      case McapOpcode::chunk:
        return contents_.sections.push_back(
            {record.offset, record.length, ByteReader(start_of(record, 8)).number<std::uint64_t>(), true});
      case McapOpcode::statistics:
        contents_.message_count = ByteReader(start_of(record, 8)).number<std::uint64_t>();
        return;
      case McapOpcode::metadata:
        return add_metadata(ByteReader(content(record)));
      case McapOpcode::data_end:
        data_ended_ = true;
        return;
      default:
        return;
    }
  }

  void add_message(const Record& record) {
    ByteReader reader(start_of(record, kMcapMessageHeaderBytes).subspan(kLogTimeOffset));
    const auto time_ns = reader.number<std::uint64_t>();
    auto& sections = contents_.sections;
    const bool continues = !sections.empty() && !sections.back().is_chunk &&
                           sections.back().offset + sections.back().length == record.start() &&
                           sections.back().length < kMaxLooseBytes;
    if (!continues) sections.push_back({record.start(), 0, time_ns, false});
    sections.back().length = record.end() - sections.back().offset;
    sections.back().start_ns = std::min(sections.back().start_ns, time_ns);
  }

  void add_metadata(ByteReader reader) {
    McapMetadata& metadata = contents_.metadata[reader.text()];
    ByteReader texts(reader.bytes(reader.number<std::uint32_t>()));
    while (texts.remaining() > 0) {
      const std::string key = texts.text();
      metadata[key] = texts.text();
    }
  }

  /// The first bytes of a record's content.
  ByteView start_of(const Record& record, std::size_t size) {
    if (record.length < size) throw std::runtime_error("a record that is too short");
    return window(record.offset, size);
  }

  ByteView content(const Record& record) {
    if (record.length > limits_.max_chunk_bytes) throw std::runtime_error("a record that is too long");
    content_.resize(record.length);
    file_.read(record.offset, content_);
    return content_;
  }

  /// Bytes of the file, which must have them. The view is valid until the next call.
  ByteView window(std::uint64_t offset, std::size_t size) {
    if (offset < window_offset_ || offset + size > window_offset_ + window_.size()) {
      window_.resize(std::min(kWindowBytes, file_.size() - offset));
      window_offset_ = offset;
      file_.read(offset, window_);
    }
    return ByteView(window_).subspan(offset - window_offset_, size);
  }

  const InputFile& file_;
  const RecordingLimits& limits_;
  McapCatalogue& catalogue_;
  std::uint64_t end_;  ///< of the records
  McapContents contents_;
  bool data_ended_ = false;
  std::uint64_t next_chunk_ = 0;  ///< none begins between the place of the last search and this one
  Bytes window_, content_;
  std::uint64_t window_offset_ = 0;
};

}  // namespace

McapContents list_contents(const InputFile& file, const RecordingLimits& limits, McapCatalogue& catalogue) {
  return Walk(file, limits, catalogue).contents();
}

}  // namespace laneloom::recording
