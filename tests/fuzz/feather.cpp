#include "io/feather.hpp"

#include "memory_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const laneloom::MemoryFile file(data, size);
  laneloom::take_or_refuse([&] {
    const laneloom::io::FeatherTable table(file.path());
    if (table.column<std::int64_t>("timestamp_ns").size() != table.rows()) __builtin_trap();
    if (table.column<std::string>("track_uuid").size() != table.rows()) __builtin_trap();
    if (table.column<double>("tx_m").size() != table.rows()) __builtin_trap();
  });
  return 0;
}
