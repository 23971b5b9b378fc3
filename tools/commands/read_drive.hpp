#pragma once

#include <string>

#include "export/drive_lines.hpp"
#include "laneloom/config.hpp"

namespace laneloom::commands {

struct ReadDrive {
  exports::DriveLines lines;
  std::string frame_id;  ///< that the coordinates are in; empty: it is not told
};

/// The lines of a drive, of a recording or JSON lines with maps, or else with detections and poses, which are
/// mapped first. Prints how many maps there were. Throws std::runtime_error naming the file if it cannot be
/// read or has nothing to make lines of.
ReadDrive read_drive(const std::string& path, const Config& config, bool strict);

}  // namespace laneloom::commands
