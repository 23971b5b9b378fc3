#include "recording/mcap_sections.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>

namespace laneloom::recording {
namespace {

constexpr std::uint64_t kWindowBytes = 4096;
/// A stretch of messages outside of chunks is cut at this size, so that few of them are in memory at a time.
constexpr std::uint64_t kMaxLooseBytes = 1U << 20U;
constexpr std::size_t kLogTimeOffset = 6;  // in a message

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
    std::uint64_t offset = check_magic();
    bool first = true, footer = false;
    while (const auto record = record_at(offset)) {
      if (first != (record->opcode == McapOpcode::header)) fail(offset, "a header is expected at the start");
      first = false;
      footer = record->opcode == McapOpcode::footer;
      if (footer) break;
      at_offset(file_, offset, [&] { take(*record); });
      offset = record->end();
    }
    if (!footer && !contents_.cut_off) fail(offset, "there is no footer");
    return std::move(contents_);
  }

 private:
  [[noreturn]] void fail(std::uint64_t offset, const std::string& what) const {
    at_offset(file_, offset, [&] { throw std::runtime_error(what); });
    throw std::logic_error("not reached");
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
  Bytes window_, content_;
  std::uint64_t window_offset_ = 0;
};

}  // namespace

McapContents list_contents(const InputFile& file, const RecordingLimits& limits, McapCatalogue& catalogue) {
  return Walk(file, limits, catalogue).contents();
}

}  // namespace laneloom::recording
