#include "laneloom/dds/cdr.hpp"
#include "laneloom/messages.hpp"
#include "laneloom/next_turn.hpp"
#include "laneloom/objects.hpp"
#include "memory_file.hpp"

namespace {

template <class T>
void decode(std::span<const std::uint8_t> bytes) {
  T message;
  const std::string_view refusal = laneloom::dds::from_cdr(bytes, "map", message);
  if (!refusal.empty()) return;
  // A message that is taken can be sent again.
  std::vector<std::uint8_t> again;
  laneloom::dds::to_cdr(message, "map", again);
}

}  // namespace

/// The first byte tells the type.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::span<const std::uint8_t> bytes(data + 1, size - 1);
  switch (data[0] % 7) {
    case 0:
      decode<laneloom::DetectionFrame>(bytes);
      break;
    case 1:
      decode<laneloom::VehiclePose>(bytes);
      break;
    case 2:
      decode<laneloom::PublishedMap>(bytes);
      break;
    case 3:
      decode<laneloom::RoadMarkings>(bytes);
      break;
    case 4:
      decode<laneloom::TrackedObjects>(bytes);
      break;
    case 5:
      decode<laneloom::NextTurn>(bytes);
      break;
    default:
      decode<laneloom::ServiceStatus>(bytes);
      break;
  }
  return 0;
}
