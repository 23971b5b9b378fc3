#include "io/json_lines.hpp"

#include <algorithm>
#include <array>
#include <iostream>
#include <stdexcept>
#include <utility>

#include "io/file_kind.hpp"
#include "io/json_fields.hpp"
#include "io/stamp_and_pose.hpp"

namespace laneloom::io {
namespace {

constexpr std::size_t kMaxLineBytes = std::size_t{64} << 20;

}  // namespace

JsonLinesReader::JsonLinesReader(const std::filesystem::path& path, FrameConventions conventions)
    : path_(path), conventions_(std::move(conventions)), text_(std::cin.rdbuf()) {
  if (path == kStandard) return;
  if (const std::string kind = file_kind(path); !kind.empty() && kind != kEmpty)
    throw std::runtime_error(path.string() + ": " + kind + "; JSON lines are needed");
  file_.open(path);
  text_.rdbuf(file_.rdbuf());
  if (!file_ || std::filesystem::is_directory(path))
    throw std::runtime_error(path.string() + ": cannot be read");
  std::error_code not_a_file;  // a pipe has no size
  size_ = std::filesystem::file_size(path, not_a_file);
  if (not_a_file) size_ = 0;
}

double JsonLinesReader::progress() const {
  return size_ > 0 ? std::min(1.0, static_cast<double>(bytes_read_) / static_cast<double>(size_)) : 0.0;
}

std::optional<FrameRecord> JsonLinesReader::next_frame() {
  LeftOut nothing(/*strict=*/true);
  return next_frame(nothing);
}

std::optional<FrameRecord> JsonLinesReader::next_frame(LeftOut& left_out) {
  return next(left_out, [&](const std::string& place) {
    return frame_from_json(line_, {left_out, place, conventions_});
  });
}

std::optional<LocalMap> JsonLinesReader::next_map() {
  LeftOut nothing(/*strict=*/true);
  return next_map(nothing);
}

std::optional<LocalMap> JsonLinesReader::next_map(LeftOut& left_out) {
  return next(left_out, [&](const std::string& /*place*/) { return map_from_json(line_); });
}

std::optional<StampedLine> JsonLinesReader::next_stamped(LeftOut& left_out) {
  return next(left_out, [&](const std::string& /*place*/) {
    return StampedLine{read_stamp_ns(parse_json(line_)), line_};
  });
}

template <typename Read>
auto JsonLinesReader::next(LeftOut& left_out, Read read)
    -> std::optional<std::invoke_result_t<Read, const std::string&>> {
  while (next_line()) {
    const std::string place = "line " + std::to_string(number_);
    try {
      return read(place);
    } catch (const JsonError& complaint) {
      if (left_out.strict()) throw error(complaint.what());
      const bool cut = !line_ended_ && line_.find_last_of("]}") != line_.size() - 1;
      left_out.add(cut ? "the last line is cut off" : complaint.reason(), place);
    }
  }
  return std::nullopt;
}

bool JsonLinesReader::next_line() {
  do {
    line_.clear();
    ++number_;
    read_line();
    if (line_.empty() && !line_ended_) return false;
    bytes_read_ += line_.size() + 1;
  } while (line_.find_first_not_of(" \t\r") == std::string::npos);
  return true;
}

/// Reads up to the next line feed, or to the end of the file, piece by piece: a line may have no end.
void JsonLinesReader::read_line() {
  std::array<char, 16384> piece{};
  do {
    text_.clear();
    text_.getline(piece.data(), piece.size());
    line_ended_ = text_.good();
    line_.append(piece.data(), static_cast<std::size_t>(text_.gcount()) - (line_ended_ ? 1 : 0));
    if (line_.size() > kMaxLineBytes) throw error("the line is too long");
  } while (text_.fail() && !text_.eof() && !text_.bad());
}

std::runtime_error JsonLinesReader::error(const std::string& complaint) const {
  return std::runtime_error(path_.string() + ":" + std::to_string(number_) + ": " + complaint);
}

void JsonLinesWriter::write_line(const std::string& line) {
  file_.stream() << line << '\n';
  file_.check();
}

}  // namespace laneloom::io
