#pragma once

#include <filesystem>
#include <vector>

#include "base/left_out.hpp"
#include "simulation/road.hpp"

namespace laneloom::simulation {

/// The Argoverse 2 logs in a directory, in the order of their names: the directory itself if it has a log's
/// poses, or else those below it, as in `sensor/val/<log id>`. A log that is in several splits of a data set
/// is taken once, from where it is the most complete: its poses, its map and its annotations can be read, and
/// it has the most poses. Throws std::runtime_error naming the directory if there is none, or a log that
/// comes twice if `left_out` is strict.
std::vector<std::filesystem::path> argoverse2_logs(const std::filesystem::path& directory, LeftOut& left_out);

/// Loads an Argoverse 2 sensor log as it is distributed: its vector map (map/log_map_archive_*.json) and the
/// recorded poses (city_SE3_egovehicle.feather). The map may also lie beside the poses, and these may be a
/// .csv with the same columns. Coordinates are the city's, unchanged; the vehicle's origin is about 0.33 m
/// above the surface.
///
/// Lanelines are the painted borders of the lanes, bicycle lanes included. A double line with two styles has
/// the style of the nearer line. Roadedges are the outlines of the drivable areas where no other area
/// adjoins. There are no stoplines in such a map. Lanes are the vehicle and bus lanes. The poses, which come
/// in pairs 1 ns apart, are resampled to 100 Hz.
///
/// Lanes, areas and poses that are wrong are left out, as is a second lane of one id. A lane without
/// successors loses its links alone. Throws std::runtime_error naming file and key, or file and line, where
/// nothing is left, and of the first of them if `left_out` is strict.
Road load_argoverse2(const std::filesystem::path& log_directory, LeftOut& left_out);

/// Does so strictly.
inline Road load_argoverse2(const std::filesystem::path& log_directory) {
  LeftOut nothing(/*strict=*/true);
  return load_argoverse2(log_directory, nothing);
}

/// The recorded poses alone, in city coordinates and at the stamps of the log's sensors, as
/// read_pose_table().
std::vector<VehiclePose> argoverse2_poses(const std::filesystem::path& log_directory, LeftOut& left_out);

}  // namespace laneloom::simulation
