#include "dds/rtps_guard.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  laneloom::dds::RtpsGuard guard;
  guard.check({data, size}, 0);
  return 0;
}
