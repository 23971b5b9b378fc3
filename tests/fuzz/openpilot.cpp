#include "import/openpilot.hpp"
#include "memory_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const laneloom::MemoryFile file(data, size);
  laneloom::LeftOut left_out;
  laneloom::take_or_refuse([&] { laneloom::imports::read_openpilot(file.path(), {left_out}); });
  return 0;
}
