#include "recording/recording.hpp"
#include "memory_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const laneloom::MemoryFile file(data, size);
  laneloom::take_or_refuse([&] {
    // Small enough that a reader that ignores its limits is seen.
    laneloom::recording::RecordingReader reader(file.path(), "map",
                                                {.max_chunk_bytes = 1U << 22U, .max_open_bytes = 1U << 24U});
    while (reader.next()) {
    }
  });
  return 0;
}
