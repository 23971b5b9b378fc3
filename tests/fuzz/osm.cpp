#include "sd_map/osm.hpp"
#include "laneloom/config.hpp"
#include "memory_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const laneloom::MemoryFile file(data, size);
  laneloom::SdMapConfig config;
  config.file = file.path();
  config.origin_latitude_deg = 49.0;
  config.origin_longitude_deg = 8.0;
  laneloom::take_or_refuse([&] { laneloom::sd_map::load_sd_map(config); });
  return 0;
}
