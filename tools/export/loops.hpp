#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "export/drive_lines.hpp"

namespace laneloom::exports {

/// Finds, for each pose of a drive, how the drive has to be bent there so that a road to which it comes back
/// is there once: odometry drifts from pass to pass. Where the drive comes back to a place after 350 m or
/// more, in either direction, its last 80 m are laid onto the lines that it left there before (align.hpp). A
/// pose graph over the stations then spreads what was found along the loop, as odometry allows. Drift of up
/// to 6 m and 1.5 degrees since the last place that was found is seen. A drive that comes back nowhere is not
/// bent. The first pose stays. Ours, beyond the paper.
std::vector<Eigen::Isometry3d> close_loops(const DriveLines& drive);

}  // namespace laneloom::exports
