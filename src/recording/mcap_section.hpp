#pragma once

#include <memory>
#include <vector>

#include "recording/mcap_sections.hpp"

namespace laneloom::recording {

/// The messages of a section, in memory and in the order of their log times.
struct LoadedSection {
  /// A message of the section.
  struct Entry {
    std::uint64_t log_time_ns = 0;
    ByteView message;  ///< content of the message's record
  };
  std::unique_ptr<std::uint8_t[]> content, decompressed;  // NOLINT(*-avoid-c-arrays): left uninitialised
  std::vector<Entry> entries;
  std::uint64_t offset = 0;  ///< of the section, for error messages
  std::uint64_t bytes = 0;   ///< memory that the section takes
};

/// Reads a section, decompresses it and checks its CRC. Adds the schemas and channels that it describes to
/// the catalogue. Throws std::runtime_error naming file and offset when the section is malformed, or takes
/// more memory than the limits allow beside the `open_bytes` that are in use.
LoadedSection load(const InputFile& file, const McapSection& section, const RecordingLimits& limits,
                   std::uint64_t open_bytes, McapCatalogue& catalogue);

}  // namespace laneloom::recording
