#pragma once

#include <optional>
#include <string>
#include <vector>

#include "recording/mcap_section.hpp"

namespace laneloom::recording {

/// A message of an MCAP file.
struct McapMessage {
  const McapChannel* channel = nullptr;
  std::uint32_t sequence = 0;         ///< as its writer counted; 0: not counted
  std::uint64_t log_time_ns = 0;      ///< time of recording
  std::uint64_t publish_time_ns = 0;  ///< time of publication
  ByteView data;                      ///< the message itself
};

/// Reads the messages of an MCAP file in the order of their log times, and messages of equal log times in the
/// order of the file. The file may have an index or not: sections whose times overlap are merged. Unknown
/// records are passed over. Every length is checked against the file and the limits before anything is
/// allocated. All throw std::runtime_error naming the file. next() throws Damage; it may then be called
/// again, and goes on behind it. Not thread-safe.
class McapReader {
 public:
  explicit McapReader(const std::string& path, const RecordingLimits& limits = {});

  /// The next message. None: the end. The message is valid until the next call.
  std::optional<McapMessage> next();

  /// Whether the file is cut off. It is then read up to its last whole record.
  bool cut_off() const { return contents_.cut_off; }
  /// What the file says of itself, by the name of the record.
  const std::map<std::string, McapMetadata>& metadata() const { return contents_.metadata; }
  /// The share of the sections that was read, 0..1.
  double progress() const;

 private:
  /// A section that is in memory.
  struct OpenSection {
    LoadedSection section;
    std::size_t number = 0;  ///< its place in the file
    std::size_t next = 0;    ///< index of its next entry
    const LoadedSection::Entry& entry() const { return section.entries[next]; }
    /// Whether the next message of `other` comes before the next one of this section.
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
  std::size_t unopened_ = 0;          ///< place in by_time_ of the first section that is not opened
  std::vector<OpenSection> open_;     ///< heap: the one with the next message is first
  std::uint64_t open_bytes_ = 0;
  std::size_t told_damages_ = 0;
  bool delivered_ = false;  ///< the first message of open_ was returned by next()
  std::uint64_t count_ = 0;
};

}  // namespace laneloom::recording
