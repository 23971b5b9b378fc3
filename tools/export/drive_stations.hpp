#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "export/drive_lines.hpp"
#include "laneloom/types.hpp"

namespace laneloom::exports {

inline constexpr double kStation_m = 10.0;  ///< driven from station to station

/// A place on a drive, with the lines that left its map since the station before. All in the drive's frame.
struct DriveStation {
  /// A place on a line.
  struct Sample {
    MarkingType type = MarkingType::laneline;
    Point position = Point::Zero();
    Eigen::Vector2d along = Eigen::Vector2d::Zero();  ///< unit direction of the line
    double stddev_m = 0.0;                            ///< lateral
  };
  Eigen::Isometry3d T_drive_body = Eigen::Isometry3d::Identity();
  double driven_m = 0.0;  ///< since the drive's first pose
  std::vector<Sample> samples;
};

/// Places along a line, every 2 m.
std::vector<DriveStation::Sample> samples_of(const Marking& line);

/// The distance that a drive had driven at each of its poses.
std::vector<double> driven_to(const DriveLines& drive);

/// The stations of a drive, which has one pose or more: at its first pose, every kStation_m, and at its last.
std::vector<DriveStation> stations_of(const DriveLines& drive);

}  // namespace laneloom::exports
