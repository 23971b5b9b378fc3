#pragma once

#include <optional>
#include <string>
#include <vector>

#include "recording/files.hpp"
#include "recording/mcap_catalogue.hpp"
#include "recording/recording.hpp"

namespace laneloom {

/// A chunk, or a stretch of messages outside of chunks.
struct McapSection {
  std::uint64_t offset = 0;  ///< of the chunk's content, or of the first message's record
  std::uint64_t length = 0;
  std::uint64_t start_ns = 0;  ///< earliest log time
  bool is_chunk = false;
};

/// What is where in an MCAP file.
struct McapContents {
  std::vector<McapSection> sections;  ///< in the order of the file
  bool has_summary = false;  ///< the catalogue knows all channels, also those described within chunks
  std::optional<std::uint64_t> message_count;  ///< as its statistics say
  bool cut_off = false;                        ///< the file ends before its end
};

/// Walks over the file from record to record, and reads neither chunks nor messages. An index is not needed,
/// and so not believed. Throws std::runtime_error naming file and offset when the file is malformed; one that
/// is cut off is not, behind its magic.
McapContents list_contents(const InputFile& file, const RecordingLimits& limits, McapCatalogue& catalogue);

/// Calls `work`, and names file and offset in the std::runtime_error that it throws.
template <class Work>
auto at_offset(const InputFile& file, std::uint64_t offset, Work work) {
  try {
    return work();
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file.path() + ": at byte " + std::to_string(offset) + ": " + error.what());
  }
}

}  // namespace laneloom
