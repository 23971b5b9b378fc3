#include "import/maptr.hpp"
#include "memory_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const laneloom::MemoryFile file(data, size);
  laneloom::LeftOut left_out;
  laneloom::imports::DriveLog drive;
  drive.stamp_ns_of = [](const std::string& token) { return static_cast<std::int64_t>(token.size()) + 1; };
  laneloom::take_or_refuse([&] { laneloom::imports::read_maptr(file.path(), {drive, left_out}); });
  return 0;
}
