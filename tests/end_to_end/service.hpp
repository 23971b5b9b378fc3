#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <string>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/messages.hpp"
#include "process.hpp"

namespace laneloom {

/// laneloomd for the vehicle of `config`.
inline std::vector<std::string> command(const DdsConfig& config, const std::vector<std::string>& more = {}) {
  std::vector<std::string> words{LANELOOMD, "--domain", std::to_string(config.domain), "--vehicle-id",
                                 config.vehicle_id};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

inline bool has_lanes(const PublishedMap& map) { return !map.map.lanes.empty(); }
inline bool is_good(const PublishedMap& map) { return has_lanes(map) && map.state == MapState::ok; }

/// A file that is removed in the end.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& name, const std::string& text) : path(unique() + name) { write(text); }
  ~TemporaryFile() { unlink(path.c_str()); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void write(const std::string& text) const { std::ofstream(path) << text; }
  const std::string path;

 private:
  static std::string unique() {
    static std::atomic<int> count = 0;
    return ::testing::TempDir() + std::to_string(getpid()) + "_" + std::to_string(++count) + "_";
  }
};

/// laneloomd, reached over DDS as `dds` says.
class Service : private TemporaryFile, public Process {
 public:
  explicit Service(const DdsConfig& dds)
      : TemporaryFile("laneloomd.yaml", "dds:\n  map_frame_id: '" + dds.map_frame_id +
                                            "'\n  security_directory: '" + dds.security_directory + "'\n"),
        Process(command(dds, {"--config", path})) {}
  using TemporaryFile::path;
};

}  // namespace laneloom
