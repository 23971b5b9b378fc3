#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "laneloom/types.hpp"
#include "simulation/drive.hpp"

/// The truth of a road: its markings, its lanes, and a drive over it.
namespace laneloom::simulation {

/// A painted marking or an edge of the road. A virtual line is no marking.
struct RoadMarking {
  ElementId id = kNoElement;
  MarkingType type = MarkingType::laneline;
  MarkingStyle style = MarkingStyle::unknown;
  Polyline points;  ///< map frame, at least two; a ring ends with its first point
};

/// A lane between two borders. Lanes begin and end at intersections, where the number of lanes of their
/// direction changes, and where a border passes from one marking to another.
struct RoadLane {
  ElementId id = kNoElement;
  Polyline left{}, right{}, centerline{};  ///< map frame, in driving direction
  ElementId left_marking = kNoElement;     ///< marking that the left border is on; kNoElement: unpainted
  ElementId right_marking = kNoElement;    ///< likewise
  bool in_intersection = false;
  std::vector<ElementId> successors{};  ///< ascending
};

/// The truth of one road, in the map frame.
struct Road {
  std::string name;
  bool right_hand_traffic = true;
  std::vector<RoadMarking> markings;
  std::vector<RoadLane> lanes;
  Drive drive;
};

/// Throws std::runtime_error if an id of a marking or a lane is 0 or given twice, or a lane refers to an id
/// that the road does not have.
void check_references(const Road& road);

/// Writes a road as one JSON object:
///
///     {"format": "laneloom-truth", "version": 1, "name": "…", "driving_side": "right" | "left",
///      "markings": [{"id": 1, "type": "laneline" | "roadedge" | "stopline",
///                    "style": "unknown" | "solid" | "dashed", "points": [[x, y, z], …]}, …],
///      "lanes": [{"id": 1, "left": [[x, y, z], …], "right": […], "centerline": […], "left_marking": 1,
///                 "right_marking": 0, "in_intersection": false, "successors": [2, …]}, …],
///      "drive": [[t, x, y, z, qx, qy, qz, qw], …]}
///
/// Coordinates are metres in the map frame, times are seconds since the drive's start, and the quaternion
/// turns body into map. A marking of 0 means that there is none. Throws std::runtime_error naming the file if
/// it cannot be written.
void save_truth(const std::filesystem::path& path, const Road& road);

/// Reads a file of save_truth(). Throws std::runtime_error naming file and key if it cannot be read, a key is
/// missing or of another type, a number is not finite, a coordinate is too far away, the lines are too long
/// in sum, or an id is unknown or given twice.
Road load_truth(const std::filesystem::path& path);

}  // namespace laneloom::simulation
