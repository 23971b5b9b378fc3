#include <atomic>
#include <chrono>
#include <cstdio>
#include <exception>
#include <thread>

#include "laneloom/dds/reader.hpp"
#include "laneloom/error.hpp"
#include "laneloom/messages.hpp"

/// Waits half a minute for a map with a lane; exit code 1: none came. Names every error that the headers
/// name.
int main() try {
  std::atomic<bool> has_lane = false;
  laneloom::dds::ReaderCallbacks<laneloom::PublishedMap> callbacks;
  callbacks.sample = [&](laneloom::PublishedMap&& map) {
    if (!map.map.lanes.empty()) has_lane = true;
  };
  const laneloom::dds::Participant participant(laneloom::DdsConfig{}, "test of the packages");
  const laneloom::dds::Reader<laneloom::PublishedMap> reader(participant, callbacks);
  for (int i = 0; i < 300 && !has_lane; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  return has_lane ? 0 : 1;
} catch (const laneloom::ConfigError& error) {
  std::fprintf(stderr, "configuration: %s\n", error.what());
  return 2;
} catch (const laneloom::dds::NotPermitted& error) {
  std::fprintf(stderr, "security: %s\n", error.what());
  return 3;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 4;
}
