#include "io/csv.hpp"

#include <fstream>
#include <string>

namespace laneloom {

void for_each_csv_row(const std::filesystem::path& path, const std::function<void(std::string_view)>& visit) {
  std::ifstream in(path);
  std::string line;
  if (!std::getline(in, line)) throw std::runtime_error(path.string() + ": cannot be read");
  for (int number = 2; std::getline(in, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    try {
      visit(line);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(path.string() + ":" + std::to_string(number) + ": " + error.what());
    }
  }
}

}  // namespace laneloom
