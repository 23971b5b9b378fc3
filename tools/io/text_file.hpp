#pragma once

#include <filesystem>
#include <fstream>
#include <istream>
#include <ostream>
#include <string>
#include <string_view>

namespace laneloom::io {

/// The name that stands for standard input or standard output.
inline constexpr const char* kStandard = "-";

/// Reads a line, without the carriage return of files that were written on Windows. False: there is none.
inline bool next_line(std::istream& in, std::string& line) {
  if (!std::getline(in, line)) return false;
  if (line.ends_with('\r')) line.pop_back();
  return true;
}

/// A text file that is written. Its name may be "-", which is standard output. Not thread-safe.
class TextFile {
 public:
  /// Throws std::runtime_error naming the file if it cannot be written.
  explicit TextFile(const std::filesystem::path& path);

  std::ostream& stream() { return *stream_; }
  /// Throws std::runtime_error naming the file if something written so far could not be written.
  void check() const;
  /// Ends the file, and throws as check().
  void close();

 private:
  std::filesystem::path path_;
  std::ofstream file_;
  std::ostream* stream_;
};

/// Writes a whole file, or none. Throws std::runtime_error naming the file if it cannot be written.
void write_text(const std::filesystem::path& path, std::string_view text);

}  // namespace laneloom::io
