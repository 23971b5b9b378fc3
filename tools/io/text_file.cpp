#include "io/text_file.hpp"

#include <iostream>
#include <stdexcept>

#include "io/new_file.hpp"

namespace laneloom::io {

TextFile::TextFile(const std::filesystem::path& path) : path_(path), stream_(&std::cout) {
  if (path == kStandard) return;
  file_.open(path);
  stream_ = &file_;
  check();
}

void TextFile::check() const {
  if (!*stream_) throw std::runtime_error(path_.string() + ": cannot be written");
}

void TextFile::close() {
  stream_->flush();
  if (stream_ == &file_) file_.close();
  check();
}

void write_text(const std::filesystem::path& path, std::string_view text) {
  make_file(path, [&] {
    TextFile file(path);
    file.stream() << text;
    file.close();
  });
}

}  // namespace laneloom::io
