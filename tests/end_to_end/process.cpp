#include "process.hpp"

#include <chrono>
#include <thread>

namespace laneloom {
namespace {

constexpr std::chrono::milliseconds kPause{10};

}  // namespace

std::optional<int> Process::wait() {
  for (int i = 0; i < 6000 && child_.running(); ++i) std::this_thread::sleep_for(kPause);
  return child_.running() ? std::nullopt : std::optional(child_.wait());
}

bool Process::wait_for_error(const std::string& text) const {
  for (int i = 0; i < 3000; ++i) {
    if (errors().find(text) != std::string::npos) return true;
    std::this_thread::sleep_for(kPause);
  }
  return false;
}

}  // namespace laneloom
