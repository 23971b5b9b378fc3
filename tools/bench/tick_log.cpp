#include "bench/tick_log.hpp"

#include <charconv>
#include <fstream>
#include <stdexcept>
#include <string>

namespace laneloom::bench {
namespace {

/// The value of "key=…" in a line.
template <class Number>
Number value(std::string_view line, std::string_view key) {
  const std::size_t at = line.find(std::string(" ") + std::string(key) + "=");
  Number result{};
  if (at != std::string_view::npos) {
    const char* begin = line.data() + at + key.size() + 2;
    if (std::from_chars(begin, line.data() + line.size(), result).ec == std::errc()) return result;
  }
  throw std::runtime_error("a tick without " + std::string(key) + ": " + std::string(line));
}

}  // namespace

std::vector<LoggedTick> read_tick_log(const std::filesystem::path& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error(path.string() + ": cannot be read");
  std::vector<LoggedTick> ticks;
  for (std::string line; std::getline(in, line);) {
    if (line.find(" event=tick ") == std::string::npos) continue;
    ticks.push_back({.map = value<std::uint64_t>(line, "map"),
                     .start_ns = value<std::int64_t>(line, "start_ns"),
                     .delay_ns = value<std::int64_t>(line, "delay_ns"),
                     .missed = value<std::uint64_t>(line, "missed")});
  }
  return ticks;
}

}  // namespace laneloom::bench
