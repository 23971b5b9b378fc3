#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "import/drive_log.hpp"

namespace laneloom {

/// Samples are called drive_<stamp>.
inline imports::DriveLog drive(double ground_z_m = 0.0) {
  imports::DriveLog drive{.name = "drive", .ground_z_m = ground_z_m};
  drive.stamp_ns_of = [](const std::string& token) -> std::optional<std::int64_t> {
    if (!token.starts_with("drive_")) return std::nullopt;
    return std::stoll(token.substr(6));
  };
  return drive;
}

}  // namespace laneloom
