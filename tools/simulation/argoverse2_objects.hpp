#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "base/left_out.hpp"
#include "laneloom/objects.hpp"
#include "laneloom/types.hpp"

namespace laneloom::simulation {

/// The file of annotations of a log. Some logs come with one that has the vehicle itself, too. None: the log
/// has no annotations.
std::optional<std::filesystem::path> annotations_in(const std::filesystem::path& log_directory);

/// The vehicles, cyclists and pedestrians that are annotated in an Argoverse 2 log (annotations.feather), by
/// the stamps of its sweeps, in the body frame. Speeds are those of the tracks, from the sweep before to the
/// one after; an object of one sweep stands. Signs, animals, cones and the like are no traffic. Of a sweep of
/// more than 256 objects, the nearest are taken. Empty: the log has no annotations. `poses` are those of the
/// log, as argoverse2_poses() gives them.
///
/// Rows that are wrong are left out. Throws std::runtime_error naming the file if it is no such table, and
/// naming the first such row if `left_out` is strict.
std::vector<TrackedObjects> argoverse2_objects(const std::filesystem::path& log_directory,
                                               const std::vector<VehiclePose>& poses, LeftOut& left_out);

}  // namespace laneloom::simulation
