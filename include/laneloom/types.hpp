#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "laneloom/basics.hpp"
#include "laneloom/elements.hpp"
#include "laneloom/way_types.hpp"

/// Plain data of laneloom, in metres, radians and nanoseconds. Frames are right-handed.
///
/// Frames: `body` is the vehicle's (x forward, y left, z up); `map` is the fixed reference frame that
/// the pose topic is given in. T_map_body takes body coordinates to map coordinates.
namespace laneloom {

static_assert(alignof(Eigen::Isometry3d) == 16,
              "compile with -DEIGEN_MAX_ALIGN_BYTES=16, as laneloom::types says: the library is laid out so");

/// One polyline that the network saw in one frame (paper, eq. 1).
struct Detection {
  MarkingType type = MarkingType::laneline;
  MarkingStyle style = MarkingStyle::unknown;  ///< unknown: the network does not tell it
  double confidence = 0.0;                     ///< 0..1, as the network tells it
  Polyline points;                             ///< body frame, at least two
  std::vector<double> stddev_m;                ///< lateral standard deviation per point; empty: not given
};

/// Everything that the network saw at one instant.
struct DetectionFrame {
  std::int64_t stamp_ns = 0;     ///< sensor clock
  std::uint64_t sequence = 0;    ///< counts per source and session
  std::uint64_t session_id = 0;  ///< of the source's run; another value means that it was restarted
  std::string source;            ///< names the perception stack
  std::vector<MarkingType> detected_types;  ///< types that the network can detect; empty: every type
  Polyline field_of_view;                   ///< body frame polygon; empty: not known
  std::vector<Polyline> occluded_areas;     ///< body frame polygons, within which nothing is seen
  std::vector<Detection> detections;        ///< empty: nothing was seen
};

/// The vehicle in the map frame at one instant.
struct VehiclePose {
  std::int64_t stamp_ns = 0;       ///< sensor clock
  std::uint64_t sequence = 0;      ///< counts up by one per message of the writer
  std::uint64_t session_id = 0;    ///< of the writer's run
  Point position = Point::Zero();  ///< of the body frame's origin, map frame
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< T_map_body, unit length
};

/// T_map_body of a pose.
inline Eigen::Isometry3d transform(const VehiclePose& pose) {
  return Eigen::Translation3d(pose.position) * pose.orientation;
}

/// The local map after one fused frame. Every id that is referred to is an element of the map.
struct LocalMap {
  std::int64_t stamp_ns = 0;                                     ///< of the newest fused frame; 0: none yet
  Eigen::Isometry3d T_map_body = Eigen::Isometry3d::Identity();  ///< at the stamp
  std::vector<Marking> markings;                                 ///< the fused markings, of all types
  std::vector<Marking> boundaries;       ///< boundaries of lanes: lanelines, roadedges, and inferred ones
  std::vector<Stopline> stoplines;       ///< with the lanes whose traffic waits there
  std::vector<Lane> lanes;               ///< in ascending order of ids
  std::vector<Linkage> linkages;         ///< between these lanes, by ascending ids
  std::optional<Way> way;                ///< from the pose on; empty: no way is known
  std::vector<DrivenPath> driven_paths;  ///< where no lane is known
  std::vector<LineageEvent> lineage;     ///< since the frame before
};

}  // namespace laneloom
