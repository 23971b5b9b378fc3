#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <ios>

namespace laneloom::io {

/// Tells which share of a file was read.
class ShareRead {
 public:
  /// `file` is open at `path`, and must live as long as this.
  ShareRead(std::ifstream& file, const std::filesystem::path& path) : buffer_(*file.rdbuf()) {
    std::error_code not_a_file;  // a pipe has no size
    const std::uintmax_t size = std::filesystem::file_size(path, not_a_file);
    if (!not_a_file) size_ = static_cast<double>(size);
  }

  /// 0..1. 0: it is not known.
  double now() const {
    const auto read = static_cast<double>(buffer_.pubseekoff(0, std::ios::cur, std::ios::in));
    return size_ > 0.0 ? std::clamp(read / size_, 0.0, 1.0) : 0.0;
  }

 private:
  std::filebuf& buffer_;
  double size_ = 0.0;
};

}  // namespace laneloom::io
