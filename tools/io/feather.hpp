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

/// A table of numbers and texts in a file of Apache Arrow's IPC format (Feather V2), compressed or not. The
/// file may be damaged: every length in it is checked before it is used. All throw std::runtime_error naming
/// the file and the problem.
class FeatherTable {
 public:
  explicit FeatherTable(const std::filesystem::path& path);

  std::size_t rows() const { return static_cast<std::size_t>(rows_); }
  /// All rows of a column. `Cell` is std::int64_t, double or std::string (UTF-8), and must be the type of the
  /// column.
  template <class Cell>
  std::vector<Cell> column(const std::string& name) const;

 private:
  /// The place of a column.
  struct Place {
    std::uint32_t column = 0;
    std::uint32_t buffer = 0;  ///< of the batch: the column's first one
  };
  /// Rows that were written together.
  struct Batch {
    recording::Bytes metadata;
    std::int64_t body_offset = 0, body_length = 0;
  };

  recording::Bytes read(std::int64_t offset, std::int64_t length) const;
  recording::Bytes read_footer() const;
  void add_batch(const arrow::Block& block);
  Place place_of(const std::string& name) const;
  template <class Number>
  void append(const Batch& batch, const Place& place, std::vector<Number>& to) const;
  void append(const Batch& batch, const Place& place, std::vector<std::string>& to) const;
  std::size_t full_rows(const Batch& batch, std::uint32_t column) const;
  recording::Bytes buffer(const Batch& batch, std::uint32_t number, std::size_t expected) const;
  template <class Work>
  auto naming_the_file(Work work) const;

  recording::InputFile file_;
  recording::Bytes footer_;
  std::vector<Batch> batches_;
  std::int64_t end_of_batches_ = 0;
  std::int64_t rows_ = 0;
};

}  // namespace laneloom::io
