#pragma once

#include <optional>
#include <string>
#include <vector>

#include "recording/mcap_section.hpp"

namespace laneloom {

struct McapMessage {
  const McapChannel* channel = nullptr;
  std::uint32_t sequence = 0;
  std::uint64_t log_time_ns = 0;
  std::uint64_t publish_time_ns = 0;
  ByteView data;
};

/// Reads the messages of an MCAP file in the order of their log times (of equal ones: in the order of the
/// file), whether it has an index or not: sections whose times overlap are merged. Records that it does not
/// know are passed over. Every length is checked against the file and the limits before anything is
/// allocated. All throw std::runtime_error naming file and offset; next() may then be called again, and goes
/// on behind what is damaged. Not thread-safe.
class McapReader {
 public:
  explicit McapReader(const std::string& path, const RecordingLimits& limits = {});

  /// None: the end. The message is there until the next call.
  std::optional<McapMessage> next();

  /// The file ends before its end; it was read up to its last whole record.
  bool cut_off() const { return contents_.cut_off; }
  /// From 0 to 1, as a share of the sections.
  double progress() const;

 private:
  struct OpenSection {
    LoadedSection section;
    std::size_t number = 0;
    std::size_t next = 0;  ///< of its entries
    const LoadedSection::Entry& entry() const { return section.entries[next]; }
    /// Whether the other's next message comes before this one's.
    bool operator<(const OpenSection& other) const;
  };

  void sort_by_time();
  void learn_channels(const McapSection& section);
  void open(std::size_t number);
  void advance_first();
  void check_count();

  InputFile file_;
  RecordingLimits limits_;
  McapCatalogue catalogue_;
  McapContents contents_;
  std::vector<std::size_t> by_time_;  ///< numbers of sections
  std::size_t unopened_ = 0;          ///< the first such one in by_time_
  std::vector<OpenSection> open_;     ///< heap: the one with the next message is first
  std::uint64_t open_bytes_ = 0;
  bool delivered_ = false;  ///< the first message of open_
  std::uint64_t count_ = 0;
};

}  // namespace laneloom
