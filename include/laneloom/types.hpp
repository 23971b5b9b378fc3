#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// Plain data of laneloom, in metres, radians and nanoseconds. Frames are right-handed.
///
/// Frames: `body` is the vehicle's (x forward, y left, z up); `map` is the fixed reference frame that
/// the pose topic is given in. T_map_body takes body coordinates to map coordinates.
namespace laneloom {

/// A place, in metres. Its frame is said where the point is used.
using Point = Eigen::Vector3d;
/// Points in the order in which they are joined.
using Polyline = std::vector<Point>;

/// Identifies an element of the map. No other element gets the same id in a session; an element that was lost
/// for a moment may come back by its id. 0 is no element.
using ElementId = std::uint64_t;
inline constexpr ElementId kNoElement = 0;

/// The side of something that has a direction, such as a lane or a line.
enum class Side : std::uint8_t { left, right };
inline constexpr std::array kSides{Side::left, Side::right};
/// The other side.
constexpr Side opposite(Side side) { return side == Side::left ? Side::right : Side::left; }
/// The side as something sees it that runs the other way, if `reversed`.
constexpr Side as_seen(Side side, bool reversed) { return reversed ? opposite(side) : side; }

/// The end of a polyline: `front` at its first point, `back` at its last one.
enum class End : std::uint8_t { front, back };
inline constexpr std::array kEnds{End::front, End::back};
/// The other end.
constexpr End opposite(End end) { return end == End::front ? End::back : End::front; }

/// A laneline bounds a lane, a roadedge bounds the road, and traffic waits at a stopline.
enum class MarkingType : std::uint8_t { laneline, roadedge, stopline };
inline constexpr std::size_t kMarkingTypeCount = 3;
inline constexpr std::array<MarkingType, kMarkingTypeCount> kMarkingTypes{
    MarkingType::laneline, MarkingType::roadedge, MarkingType::stopline};

/// The paint of a line. Unknown: no detection told it.
enum class MarkingStyle : std::uint8_t { unknown, solid, dashed };
inline constexpr std::size_t kMarkingStyleCount = 3;

/// The place of an enumerator in an array that has one entry for each.
///@{
constexpr std::size_t index(MarkingType type) { return static_cast<std::size_t>(type); }
constexpr std::size_t index(MarkingStyle style) { return static_cast<std::size_t>(style); }
constexpr std::size_t index(Side side) { return static_cast<std::size_t>(side); }
constexpr std::size_t index(End end) { return static_cast<std::size_t>(end); }
///@}

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

/// A stretch of a polyline, by arc length from its first point.
struct Stretch {
  double from_m = 0.0;                             ///< arc length of its beginning
  double to_m = 0.0;                               ///< arc length of its end
  double length() const { return to_m - from_m; }  ///< metres
};

/// An element's status tells how far a planner can rely on it.
enum class ElementStatus : std::uint8_t {
  tentative,  ///< seen, not yet enough to rely on
  confirmed,  ///< observed often enough
  inferred    ///< not observed, but concluded from observed elements
};

/// A marking has one style along a stretch of it.
struct StyleRange {
  Stretch range;  ///< on the marking
  MarkingStyle style = MarkingStyle::unknown;
};

/// An id came into the map or left it, since the map before.
struct LineageEvent {
  /// The event.
  enum class Kind : std::uint8_t {
    born,         ///< `id` is new
    merged_into,  ///< `id` left the map and goes on as part of `other`
    split_from,   ///< `id` is new and was part of `other`
    retired       ///< `id` left the map
  };
  Kind kind = Kind::born;
  ElementId id = kNoElement;     ///< the boundary or stopline that it happened to
  ElementId other = kNoElement;  ///< merged into or split from; else none
};

/// A vectorised marking of the map.
struct Marking {
  ElementId id = kNoElement;
  MarkingType type = MarkingType::laneline;
  ElementStatus status = ElementStatus::confirmed;
  Polyline points;                       ///< map frame
  std::vector<StyleRange> styles;        ///< along the points, in order, covering them
  std::vector<double> lateral_stddev_m;  ///< per point; empty: not estimated
  double existence_probability = -1.0;   ///< 0..1; -1: not estimated
  std::uint64_t observations = 0;        ///< detections that contributed
  std::int64_t first_seen_ns = 0;        ///< stamp of the first frame that saw it
  std::int64_t last_seen_ns = 0;         ///< stamp of the newest frame that saw it; 0: not known
};

/// A lane on the other side of a boundary, along a stretch. Each of two neighbours names the other.
struct Neighbour {
  ElementId lane = kNoElement;     ///< id of the lane on the other side
  Stretch range;                   ///< on the centerline of the lane that names it
  std::vector<Stretch> crossable;  ///< within the range: where the line between the two is dashed
};

/// A lane between two boundaries (paper, Sec. III-D).
struct Lane {
  /// The direction of traffic, with respect to the order of the centerline's points.
  enum class Direction : std::uint8_t { unknown, along_centerline, against_centerline };
  ElementId id = kNoElement;
  ElementId left_boundary = kNoElement;     ///< id of an element of LocalMap::boundaries
  ElementId right_boundary = kNoElement;    ///< likewise
  Stretch left_range;                       ///< on the left boundary
  Stretch right_range;                      ///< on the right boundary
  bool left_reversed = false;               ///< the left boundary runs against the lane; not published
  bool right_reversed = false;              ///< the same of the right boundary
  Polyline left, right, centerline;         ///< map frame, all in the same direction
  double width_m = 0.0;                     ///< mean over its length
  std::vector<Neighbour> left_neighbours;   ///< in the order of their ranges
  std::vector<Neighbour> right_neighbours;  ///< likewise
  Direction direction = Direction::unknown;
  std::uint32_t section = 0;  ///< lanes of one road section share it, within one map
  ElementStatus status = ElementStatus::confirmed;
  double existence_probability = -1.0;   ///< 0..1; -1: not estimated
  std::vector<Stretch> inferred_ranges;  ///< stretches of the centerline beside borders that were not seen
};

/// A stopline, and the lanes whose traffic waits there.
struct Stopline {
  Marking marking;                ///< of type stopline
  std::vector<ElementId> lanes;   ///< the lanes that it ends, by ascending id
  Point heading = Point::Zero();  ///< unit vector of the traffic it stops, map frame; zero: unknown
};

/// `to` continues `from`.
struct Linkage {
  /// The evidence by which the mapper knows the linkage; of several, the surest.
  enum class Kind : std::uint8_t {
    shared_boundary,      ///< both lanes run along one boundary
    geometric_alignment,  ///< the ends of the lanes are aligned
    intersection,         ///< the lanes fit to each other across an intersection
    sd_map,               ///< a linkage across an intersection that the SD map confirms
    ego_track             ///< the vehicle drove from one lane to the other
  };
  /// The turn that traffic makes on it.
  enum class Turn : std::uint8_t { unknown, straight, left, right, u_turn };
  ElementId from = kNoElement;  ///< id of a lane
  ElementId to = kNoElement;    ///< id of the lane that continues it
  Kind kind = Kind::shared_boundary;
  Turn turn = Turn::unknown;
  double confidence = 1.0;  ///< 0..1
  Polyline path;            ///< map frame, across a gap; empty: the lanes meet
};

/// The local map after one fused frame. Every id that is referred to is an element of the map.
struct LocalMap {
  std::int64_t stamp_ns = 0;                                     ///< of the newest fused frame; 0: none yet
  Eigen::Isometry3d T_map_body = Eigen::Isometry3d::Identity();  ///< at the stamp
  std::vector<Marking> markings;                                 ///< the fused markings, of all types
  std::vector<Marking> boundaries;    ///< boundaries of lanes: lanelines, roadedges, and inferred ones
  std::vector<Stopline> stoplines;    ///< with the lanes that they end
  std::vector<Lane> lanes;            ///< in ascending order of ids
  std::vector<Linkage> linkages;      ///< between these lanes, by ascending ids
  std::vector<LineageEvent> lineage;  ///< since the frame before
};

}  // namespace laneloom
