#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/messages.hpp"
#include "process.hpp"
#include "temporary_folder.hpp"

namespace laneloom {

/// laneloomd for the vehicle of `config`.
inline std::vector<std::string> command(const DdsConfig& config, const std::vector<std::string>& more = {}) {
  std::vector<std::string> words{LANELOOMD, "--domain", std::to_string(config.domain), "--vehicle-id",
                                 config.vehicle_id};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// For what Fast DDS 2.9 now and then does not manage.
inline bool one_of_three(const std::function<bool()>& attempt) { return attempt() || attempt() || attempt(); }

inline bool has_lanes(const PublishedMap& map) { return !map.map.lanes.empty(); }
inline bool is_good(const PublishedMap& map) { return has_lanes(map) && map.state == MapState::ok; }

/// A file that is removed in the end.
class TemporaryFile {
  const TemporaryFolder folder_;

 public:
  TemporaryFile(const std::string& name, const std::string& text) : path(folder_.file(name)) { write(text); }
  void write(const std::string& text) const { std::ofstream(path) << text; }

  const std::string path;
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
