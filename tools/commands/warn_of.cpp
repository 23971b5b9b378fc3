#include "commands/warn_of.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace laneloom::commands {

void warn_of(const std::filesystem::path& path, const Counters& refused, bool cut_off) {
  for (const auto& [what, count] : refused.values())
    fmt::print(stderr, "laneloom: {}: {} messages passed over: {}\n", path.string(), count, what);
  if (cut_off) fmt::print(stderr, "laneloom: {}: the recording is cut off\n", path.string());
}

}  // namespace laneloom::commands
