#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>

namespace laneloom {

/// When each detection frame was handed to DDS, as a table "sequence,published_ns" (system clock).
class PublicationLogWriter {
 public:
  /// Throws std::runtime_error where the file cannot be written.
  explicit PublicationLogWriter(const std::filesystem::path& path);
  void add(std::uint64_t sequence, std::int64_t published_ns);
  /// Throws std::runtime_error where writing failed.
  void close();

 private:
  std::filesystem::path path_;
  std::ofstream out_;
};

/// Times by sequence. Throws std::runtime_error naming file and line.
std::map<std::uint64_t, std::int64_t> read_publication_log(const std::filesystem::path& path);

}  // namespace laneloom
