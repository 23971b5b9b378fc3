#include "io/json_lines.hpp"
#include "memory_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const laneloom::MemoryFile file(data, size);
  laneloom::take_or_refuse([&] {
    laneloom::io::JsonLinesReader reader(file.path());
    while (reader.next_map()) {
    }
  });
  return 0;
}
