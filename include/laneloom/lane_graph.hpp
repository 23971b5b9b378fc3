#pragma once

#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <vector>

#include "laneloom/polyline.hpp"
#include "laneloom/types.hpp"

/// A local map as a planner looks at it: the lane that the vehicle is in, what follows it, what lies beside
/// it. Everything here is pure and may be used by several threads at once.
namespace laneloom {

/// A lane of a map, and the sense in which it is walked.
struct DirectedLane {
  const Lane* lane = nullptr;  ///< of a map, which must outlive this
  bool against = false;        ///< the lane is walked against the order of its points

  /// The lane's centerline in the order in which it is walked; map frame.
  Polyline centerline() const;
  /// Whether traffic is known to run against the sense in which the lane is walked, or either way.
  bool oncoming() const;
};

/// A way on from the end of one lane, as it is walked, to the beginning of another.
struct Passage {
  DirectedLane to;  ///< walked in the same sense as the lane that the passage leaves
  Polyline path;    ///< across the gap, map frame, as it is walked; empty: the lanes meet
  Linkage::Turn turn = Linkage::Turn::unknown;  ///< in the sense in which it is walked; never unknown
  double probability = 0.0;                     ///< 0..1
};

/// A place in a lane.
struct LanePosition {
  DirectedLane lane;      ///< the sense in which places are measured
  double arc_m = 0.0;     ///< along the centerline, as it is walked
  double offset_m = 0.0;  ///< from the centerline; left of it, as it is walked, is positive
};

/// The turn from the direction in which one lane is left to the direction in which another is entered, both
/// of unit length. Angles of 50 to 130 degrees are left or right, larger ones are a U-turn, smaller ones
/// straight on.
Linkage::Turn turn_between(const Eigen::Vector2d& leaving, const Eigen::Vector2d& entering);
/// The same from the end of a lane to the beginning of another, both along their points.
Linkage::Turn turn_between(const Lane& from, const Lane& to);

/// The foot of a place on the lane's centerline; empty where the place is not in the lane, which is half its
/// width to either side, on its level: the lane lies up to 2 m above the place or 5 m below it, since the
/// origin of a vehicle's body may lie on its roof.
std::optional<Projection> foot_in(const Lane& lane, const Point& place);

/// The cosine between the vehicle's heading and the centerline, where the vehicle drives in the lane, or at
/// most `beyond_m` beside it; 0 where the vehicle is elsewhere, or crosses the lane at more than 45 degrees.
double ego_alignment(const Lane& lane, const Eigen::Isometry3d& T_map_body, double beyond_m = 0.0);

/// The neighbours on one side of the lane. Sides are as the lane's points run.
const std::vector<Neighbour>& neighbours(const Lane& lane, Side side);

/// The lanes of one map by their ids, and how they follow one another.
class LaneGraph {
 public:
  /// `map` must outlive this and stay unchanged. Linkages to lanes that it does not hold are left out.
  explicit LaneGraph(const LocalMap& map);
  explicit LaneGraph(LocalMap&&) = delete;  // it would be gone

  /// The map that the constructor was given.
  const LocalMap& map() const { return map_; }

  /// The lane of an id. Null: the map has no such lane.
  const Lane* find(ElementId id) const;

  /// The lane at a place, the nearest where several lanes overlap; null: there is none.
  const Lane* at(const Point& place) const;

  /// The lane that the vehicle drives in, walked in the vehicle's sense. Of overlapping lanes it is the one
  /// with which the vehicle's heading is aligned best. A strip that is no lane (Lane::is_drivable())
  /// is it only where the vehicle is in nothing else. Empty: the vehicle is in no lane of the map.
  std::optional<LanePosition> own_lane(const Eigen::Isometry3d& T_map_body) const;

  /// The passages from the end of a lane, in the order of the map's linkages.
  std::vector<Passage> successors(const DirectedLane& lane) const;

  /// The passages ahead, one after the other, over `reach_m` from the beginning of `lane`. Each is the best
  /// for the wished turn; once that turn was made, straight on is wished. Each lane is walked once at most,
  /// and strips that are no lanes never.
  std::vector<Passage> ahead(const DirectedLane& lane, Linkage::Turn wished, double reach_m) const;

  /// The neighbouring lane on a side at an arc length of the centerline. Side and arc length are as `lane` is
  /// walked. Null: there is none.
  const Lane* beside(const DirectedLane& lane, Side side, double arc_m) const;

 private:
  const LocalMap& map_;
  std::map<ElementId, const Lane*> lanes_;
};

/// The best passage for a wished turn: one that makes the turn, else one straight on, else any. Of equals it
/// is the one of higher probability. A passage into oncoming traffic counts one step less. Null: `passages`
/// is empty.
const Passage* best_passage(const std::vector<Passage>& passages, Linkage::Turn wished);

}  // namespace laneloom
