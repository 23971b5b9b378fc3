#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "recording/files.hpp"

namespace laneloom::arrow {
struct Block;
}

namespace laneloom::io {

/// A table of numbers in a file of Apache Arrow's IPC format (Feather V2), compressed or not. The file may be
/// damaged: every length in it is checked before it is used. All throw std::runtime_error naming the file and
/// the problem.
class FeatherTable {
 public:
  explicit FeatherTable(const std::filesystem::path& path);

  std::size_t rows() const { return static_cast<std::size_t>(rows_); }
  /// All rows of a column. `Number` is std::int64_t or double, and must be the type of the column.
  template <class Number>
  std::vector<Number> column(const std::string& name) const;

 private:
  /// Rows that were written together.
  struct Batch {
    recording::Bytes metadata;
    std::int64_t body_offset = 0, body_length = 0;
  };

  recording::Bytes read(std::int64_t offset, std::int64_t length) const;
  recording::Bytes read_footer() const;
  void add_batch(const arrow::Block& block);
  std::uint32_t index_of(const std::string& name) const;
  template <class Number>
  void append(const Batch& batch, std::uint32_t column, std::vector<Number>& to) const;
  template <class Work>
  auto naming_the_file(Work work) const;

  recording::InputFile file_;
  recording::Bytes footer_;
  std::vector<Batch> batches_;
  std::int64_t end_of_batches_ = 0;
  std::int64_t rows_ = 0;
};

}  // namespace laneloom::io
