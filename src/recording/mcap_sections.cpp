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
constexpr auto kLastOpcode = static_cast<std::uint8_t>(McapOpcode::data_end);
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
        offset = next_place(start + 1);
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
      if (next_place(offset + 1)) fail(offset, "a record that is longer than the file, or none");
      return std::nullopt;
    }
    if (is_first != (record->opcode == McapOpcode::header)) fail(offset, "a header is expected at the start");
    if (record->opcode == McapOpcode::footer) {
      if (!contents_.cut_off && record->end() != end_) fail(offset, "a footer that is not at the end");
      return std::nullopt;
    }
    if (swallows_others(*record)) fail(offset, "a record of another length than it says");
    try {
      at_offset(file_, offset, [&] { take(*record); });
    } catch (const Damage& damage) {
      add(damage);
    }
    return record->end();
  }

  /// Whether a record has a wrong length, so that others would be lost with it: none comes behind it.
  bool swallows_others(const Record& record) {
    if (record.opcode == McapOpcode::chunk)
      return !is_chunk(record.start()) && next_place(record.start() + 1).has_value();
    if (record.opcode != McapOpcode::message || !is_behind_message() || may_begin(record.end())) return false;
    // If no other lies within it, the one behind it is the damaged one.
    const auto next = next_place(record.start() + 1);
    return next && *next < record.end();
  }

  void add(const Damage& damage) {
    if (contents_.damages.size() < kMaxDamages) contents_.damages.push_back(damage);
  }

  /// The offset of the next chunk, or of the next message outside of chunks, told by their headers. None: no
  /// other follows.
  std::optional<std::uint64_t> next_place(std::uint64_t offset) {
    offset = std::max(offset, next_place_);  // what was searched already is not searched again
    while (offset < end_ && !is_place(offset)) ++offset;
    next_place_ = std::min(offset, end_);
    return next_place_ < end_ ? std::optional(next_place_) : std::nullopt;
  }

  bool is_place(std::uint64_t offset) {
    const McapOpcode opcode{window(offset, 1)[0]};
    if (opcode == McapOpcode::chunk) return is_chunk(offset);
    return opcode == McapOpcode::message && is_behind_message() && is_message(offset);
  }

  /// Whether messages lie outside of chunks here. Those of a chunk are not read without its CRC.
  bool is_behind_message() const {
    return !contents_.sections.empty() && !contents_.sections.back().is_chunk;
  }

  /// Whether a message begins here: of a channel that is known, and with another record or the end behind it.
  /// Less would be met by chance, as messages may contain any bytes.
  bool is_message(std::uint64_t offset) try {
    const auto length = length_at(offset);
    if (!length || *length < kMcapMessageHeaderBytes) return false;
    const std::uint64_t content = offset + kMcapRecordHeaderBytes;
    catalogue_.channel(ByteReader(window(content, kMcapMessageHeaderBytes)).number<std::uint16_t>());
    return may_begin(content + *length);
  } catch (const std::runtime_error&) {
    return false;
  }

  /// Whether a record of any kind may begin here, or the records end.
  bool may_begin(std::uint64_t offset) {
    return offset == end_ || (length_at(offset) && window(offset, 1)[0] <= kLastOpcode);
  }

  /// The length that a record of this place would have. None: there is none, or it is longer than the file.
  std::optional<std::uint64_t> length_at(std::uint64_t offset) {
    if (end_ - offset < kMcapRecordHeaderBytes) return std::nullopt;
    ByteReader reader(window(offset, kMcapRecordHeaderBytes));
    // A file system may leave zeros for an end that did not get to disk.
    const bool is_record = reader.number<std::uint8_t>() != 0;
    const auto length = reader.number<std::uint64_t>();
    return is_record && length <= end_ - offset - kMcapRecordHeaderBytes ? std::optional(length)
                                                                         : std::nullopt;
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
    if (const auto length = length_at(offset))
      return Record{McapOpcode{window(offset, 1)[0]}, offset + kMcapRecordHeaderBytes, *length};
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
  std::uint64_t next_place_ = 0;  ///< none begins between the place of the last search and this one
  Bytes window_, content_;
  std::uint64_t window_offset_ = 0;
};

}  // namespace

McapContents list_contents(const InputFile& file, const RecordingLimits& limits, McapCatalogue& catalogue) {
  return Walk(file, limits, catalogue).contents();
}

}  // namespace laneloom::recording
