#include "commands/warn_of.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "io/printable.hpp"

namespace laneloom::commands {

void warn_of(const std::filesystem::path& path, const LeftOut& left_out) {
  if (left_out.empty()) return;
  fmt::print(stderr, "laneloom: {}: left out: {}\n", path.string(), io::printable(left_out.summary()));
}

void warn_of(const std::filesystem::path& path, const Counters& refused, const LeftOut& left_out) {
  for (const auto& [what, count] : refused.values())
    fmt::print(stderr, "laneloom: {}: {} messages passed over: {}\n", path.string(), count, what);
  warn_of(path, left_out);
}

}  // namespace laneloom::commands
