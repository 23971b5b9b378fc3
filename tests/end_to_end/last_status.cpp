#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>

#include "recording/recording.hpp"

// last_status RECORDING: the counters of the last status in it, as one JSON object.
int main(int argc, char** argv) try {
  if (argc != 2) throw std::runtime_error("usage: last_status RECORDING");
  laneloom::recording::RecordingReader reader(argv[1]);
  auto counters = nlohmann::json::object();
  while (const auto recorded = reader.next()) {
    const auto* status = std::get_if<laneloom::ServiceStatus>(&recorded->message);
    if (!status) continue;
    for (const auto& [name, value] : status->counters) counters[name] = value;
  }
  std::puts(counters.dump().c_str());
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
