#include "simulation/argoverse2.hpp"

#include <algorithm>
#include <filesystem>

#include "io/work_folder.hpp"
#include "memory_file.hpp"

/// The table of poses, a zero byte, and the map.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::uint8_t* const end = data + size;
  const std::uint8_t* const zero = std::find(data, end, std::uint8_t{0});
  const std::uint8_t* const map = zero == end ? end : zero + 1;
  const laneloom::MemoryFile poses_file(data, static_cast<std::size_t>(zero - data));
  const laneloom::MemoryFile map_file(map, static_cast<std::size_t>(end - map));
  const laneloom::io::WorkFolder folder;
  std::filesystem::create_symlink(poses_file.path(), folder.file("city_SE3_egovehicle.csv"));
  std::filesystem::create_symlink(map_file.path(), folder.file("log_map_archive_x.json"));
  laneloom::LeftOut left_out;
  laneloom::take_or_refuse([&] { laneloom::simulation::load_argoverse2(folder.file(""), left_out); });
  return 0;
}
