#include "memory_file.hpp"
#include "simulation/road.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const laneloom::MemoryFile file(data, size);
  laneloom::take_or_refuse([&] { laneloom::simulation::load_truth(file.path()); });
  return 0;
}
