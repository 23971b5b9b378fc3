#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>

namespace laneloom::support {

/// Writes a table "session_id,sequence,published_ns" with the time (system clock) at which each detection
/// frame of a session was handed to DDS. Each line is flushed, so that the table of a killed publisher is
/// complete.
class PublicationLogWriter {
 public:
  /// Throws std::runtime_error where the file cannot be written.
  PublicationLogWriter(const std::filesystem::path& path, std::uint64_t session_id);
  void add(std::uint64_t sequence, std::int64_t published_ns);
  /// Throws std::runtime_error where writing failed.
  void close();

 private:
  std::filesystem::path path_;
  std::uint64_t session_id_;
  std::ofstream out_;
};

/// The publication times of one session, in nanoseconds of the system clock.
struct PublicationLog {
  std::uint64_t session_id = 0;
  std::map<std::uint64_t, std::int64_t> times_ns;  ///< by sequence
};

/// Reads such a table. Throws std::runtime_error naming file and line.
PublicationLog read_publication_log(const std::filesystem::path& path);

}  // namespace laneloom::support
