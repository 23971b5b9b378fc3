#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "laneloom/basics.hpp"

/// The elements of a local map (LocalMap, in types.hpp).
namespace laneloom {

/// An element's status tells how far a planner can rely on it.
enum class ElementStatus : std::uint8_t {
  tentative,  ///< seen, not yet enough to rely on
  confirmed,  ///< observed often enough
  inferred    ///< not observed, but concluded from observed elements
};

/// What tells something of the map: one kind of evidence, or several as a set.
enum class Evidence : std::uint8_t {
  none = 0,
  markings = 1,  ///< painted lines
  edges = 2,     ///< edges of the road
  ego_path = 4,  ///< the vehicle drove there
  traffic = 8,   ///< others drove there
  sd_map = 16,   ///< the SD map
};
inline constexpr std::array kEvidenceKinds{Evidence::markings, Evidence::edges, Evidence::ego_path,
                                           Evidence::traffic, Evidence::sd_map};
constexpr Evidence operator|(Evidence a, Evidence b) {
  return static_cast<Evidence>(static_cast<std::uint8_t>(a) | static_cast<std::uint8_t>(b));
}
constexpr Evidence operator&(Evidence a, Evidence b) {
  return static_cast<Evidence>(static_cast<std::uint8_t>(a) & static_cast<std::uint8_t>(b));
}
constexpr Evidence& operator|=(Evidence& a, Evidence b) { return a = a | b; }
/// Whether two sets have a kind in common.
constexpr bool overlap(Evidence a, Evidence b) { return (a & b) != Evidence::none; }

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
  /// The kind of element that the ids name.
  enum class Element : std::uint8_t { boundary, stopline, lane };
  Kind kind = Kind::born;
  Element element = Element::boundary;
  ElementId id = kNoElement;     ///< the element that it happened to
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

/// What bounds a lane on one side, along a stretch of it.
struct Border {
  ElementId boundary = kNoElement;  ///< id of an element of LocalMap::boundaries; kNoElement: it is unseen
  Stretch range;                    ///< on the lane's centerline
  Stretch on_boundary;              ///< on the boundary, as it runs itself
  bool reversed = false;            ///< the boundary runs against the lane; not published
};

/// A lane between its borders (paper, Sec. III-D).
struct Lane {
  /// The direction of traffic, with respect to the order of the centerline's points. Both: traffic runs
  /// either way.
  enum class Direction : std::uint8_t { unknown, along_centerline, against_centerline, both };
  /// What the strip is for. A planner drives in lanes alone.
  enum class Use : std::uint8_t { unknown, lane, shoulder, parking, cycle };
  ElementId id = kNoElement;
  std::vector<Border> left_borders;   ///< in order along the centerline, which they cover without overlap
  std::vector<Border> right_borders;  ///< likewise
  Polyline left, right, centerline;   ///< map frame, all in the same direction
  double width_m = 0.0;               ///< mean over its length
  std::vector<Neighbour> left_neighbours;   ///< in the order of their ranges
  std::vector<Neighbour> right_neighbours;  ///< likewise
  Direction direction = Direction::unknown;
  double direction_probability = -1.0;           ///< 0..1, of the direction; -1: it is unknown
  Evidence direction_evidence = Evidence::none;  ///< what tells the direction
  Use use = Use::unknown;
  double use_probability = -1.0;  ///< 0..1, of the use; -1: not estimated
  std::uint32_t section = 0;      ///< lanes of one road section share it, within one map
  ElementStatus status = ElementStatus::confirmed;
  double existence_probability = -1.0;   ///< 0..1; -1: not estimated
  Evidence evidence = Evidence::none;    ///< what tells that the lane is there
  std::vector<Stretch> inferred_ranges;  ///< stretches of the centerline beside borders that were not seen

  /// The borders on a side, as the centerline runs.
  const std::vector<Border>& borders(Side side) const {
    return side == Side::left ? left_borders : right_borders;
  }
  std::vector<Border>& borders(Side side) { return side == Side::left ? left_borders : right_borders; }
  /// The border on a side beside an arc length of the centerline. Null: none was seen there.
  const Border* border_at(Side side, double arc_m) const;
  /// Whether a planner may drive into it: it is no strip at the side of the road.
  bool is_drivable() const { return use == Use::lane || use == Use::unknown; }
};

inline const Border* Lane::border_at(Side side, double arc_m) const {
  for (const Border& border : borders(side))
    if (border.range.from_m <= arc_m && arc_m <= border.range.to_m && border.boundary != kNoElement)
      return &border;
  return nullptr;
}

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
    ego_track,            ///< the vehicle drove from one lane to the other
    traffic               ///< others drove from one lane to the other
  };
  /// The turn that traffic makes on it.
  enum class Turn : std::uint8_t { unknown, straight, left, right, u_turn };
  ElementId from = kNoElement;  ///< id of a lane
  ElementId to = kNoElement;    ///< id of the lane that continues it
  Kind kind = Kind::shared_boundary;
  Turn turn = Turn::unknown;
  double probability = 1.0;            ///< 0..1
  Evidence evidence = Evidence::none;  ///< what tells that the one continues the other
  Polyline path;                       ///< map frame, across a gap; empty: the lanes meet
};

/// A path that others drove, where no lane between markings is known.
struct DrivenPath {
  ElementId id = kNoElement;
  Polyline points;                ///< map frame, in the order in which they were driven
  double lateral_stddev_m = 0.0;  ///< of the path's middle
  double probability = 0.0;       ///< 0..1, that traffic runs there
};

}  // namespace laneloom
