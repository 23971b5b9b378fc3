#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "laneloom/config.hpp"
#include "process.hpp"

namespace laneloom {

/// The configuration file of a service. Removed in the end.
class ServiceConfigFile {
 public:
  explicit ServiceConfigFile(const DdsConfig& dds) {
    static int count = 0;
    const auto name = "laneloomd_" + std::to_string(getpid()) + "_" + std::to_string(++count) + ".yaml";
    path = std::filesystem::temp_directory_path() / name;
    std::ofstream(path) << "dds:\n  domain: " << dds.domain << "\n  vehicle_id: '" << dds.vehicle_id
                        << "'\n  map_frame_id: '" << dds.map_frame_id << "'\n  security_directory: '"
                        << dds.security_directory << "'\n";
  }
  ~ServiceConfigFile() { unlink(path.c_str()); }
  ServiceConfigFile(const ServiceConfigFile&) = delete;
  ServiceConfigFile& operator=(const ServiceConfigFile&) = delete;

  std::string path;
};

/// laneloomd, reached over DDS as `dds` says.
class Service : private ServiceConfigFile, public Process {
 public:
  explicit Service(const DdsConfig& dds) : ServiceConfigFile(dds), Process({LANELOOMD, "--config", path}) {}
};

}  // namespace laneloom
