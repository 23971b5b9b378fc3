#include "io/csv.hpp"

#include <fstream>
#include <string>
#include <string_view>

#include "io/file_kind.hpp"
#include "io/text_file.hpp"

namespace laneloom::io {
namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

}  // namespace

void for_each_csv_row(const std::filesystem::path& path, std::string_view columns,
                      const std::function<void(std::string_view)>& visit) {
  LeftOut nothing(/*strict=*/true);
  for_each_csv_row(path, columns, nothing, visit);
}

void for_each_csv_row(const std::filesystem::path& path, std::string_view columns, LeftOut& left_out,
                      const std::function<void(std::string_view)>& visit) {
  if (const std::string kind = file_kind(path); !kind.empty())
    throw std::runtime_error(path.string() + ": " + kind + "; a table of comma-separated values is needed");
  std::ifstream in(path);
  std::string line;
  if (!next_line(in, line)) throw std::runtime_error(path.string() + ": cannot be read");
  if (line.starts_with(kByteOrderMark)) line.erase(0, kByteOrderMark.size());
  if (line != columns && !line.starts_with(std::string(columns) + ","))
    throw std::runtime_error(path.string() + ":1: the columns must be " + std::string(columns));
  for (int number = 2; next_line(in, line); ++number) {
    if (line.empty()) continue;
    try {
      visit(line);
    } catch (const std::runtime_error& error) {
      const std::string place = ":" + std::to_string(number);
      if (left_out.strict()) throw std::runtime_error(path.string() + place + ": " + error.what());
      left_out.add(error.what(), path.filename().string() + place);
    }
  }
}

}  // namespace laneloom::io
