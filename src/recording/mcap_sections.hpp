#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "recording/damage.hpp"
#include "recording/files.hpp"
#include "recording/mcap_catalogue.hpp"
#include "recording/recording.hpp"

namespace laneloom::recording {

/// A chunk, or a stretch of messages outside of chunks.
struct McapSection {
  std::uint64_t offset = 0;    ///< of the chunk's content, or of the first message's record
  std::uint64_t length = 0;    ///< in bytes
  std::uint64_t start_ns = 0;  ///< earliest log time
  bool is_chunk = false;       ///< else messages outside of chunks
};

/// The sections of an MCAP file.
struct McapContents {
  std::vector<McapSection> sections;  ///< in the order of the file
  bool has_summary = false;           ///< the summary described all channels, also those within chunks
  std::optional<std::uint64_t> message_count;    ///< by the file's statistics
  bool cut_off = false;                          ///< the file ends before its footer
  std::map<std::string, McapMetadata> metadata;  ///< by name
  std::vector<Damage> damages;                   ///< places that were passed over, in the order of the file
};

/// Walks over the file from record to record, without reading chunks and messages. An index is neither needed
/// nor trusted. What is behind a malformed record is passed over, up to the next chunk, or behind messages
/// outside of chunks up to the next such message. Throws std::runtime_error naming the file when it does not
/// begin as MCAP does.
McapContents list_contents(const InputFile& file, const RecordingLimits& limits, McapCatalogue& catalogue);

/// Calls `work`. A std::runtime_error that it throws becomes Damage at this offset.
template <class Work>
auto at_offset(const InputFile& file, std::uint64_t offset, Work work) {
  try {
    return work();
  } catch (const std::runtime_error& error) {
    throw Damage(file.path(), "byte " + std::to_string(offset), error.what());
  }
}

}  // namespace laneloom::recording
