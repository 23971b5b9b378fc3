#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

namespace laneloom::bench {

/// One tick of laneloomd, from its log at level debug.
struct LoggedTick {
  std::uint64_t map = 0;      ///< sequence of the map that it published
  std::int64_t start_ns = 0;  ///< system clock
  std::int64_t delay_ns = 0;  ///< from its deadline to its start
  std::uint64_t missed = 0;   ///< number of deadlines without a tick since the tick before
};

/// Reads the ticks of a log; other lines are passed over. Throws std::runtime_error if the file cannot be
/// read, or a tick's line is malformed.
std::vector<LoggedTick> read_tick_log(const std::filesystem::path& path);

}  // namespace laneloom::bench
