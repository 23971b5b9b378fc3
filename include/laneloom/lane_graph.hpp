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

/// A lane in the sense in which it is walked. Refers to a lane of a map.
struct DirectedLane {
  const Lane* lane = nullptr;
  bool against = false;  ///< the order of the lane's points

  /// As it is walked; map frame.
  Polyline centerline() const;
  /// Whether it is known that traffic comes the other way.
  bool oncoming() const;
};

/// From the end of one lane, as it is walked, to the beginning of another.
struct Passage {
  DirectedLane to;
  Polyline path;  ///< across the gap, map frame, as it is walked; empty: the lanes meet
  Linkage::Turn turn = Linkage::Turn::unknown;  ///< as it is walked; never unknown
  double confidence = 0.0;                      ///< 0..1
};

/// A place in a lane.
struct LanePosition {
  DirectedLane lane;
  double arc_m = 0.0;     ///< along the centerline, as it is walked
  double offset_m = 0.0;  ///< from the centerline; left of it, as it is walked, is positive
};

/// Which way one turns who leaves in the one direction and enters in the other, both of unit length: a turn
/// is one of 50 to 130 degrees.
Linkage::Turn turn_between(const Eigen::Vector2d& leaving, const Eigen::Vector2d& entering);
/// The same from the end of a lane to the beginning of another, both along their points.
Linkage::Turn turn_between(const Lane& from, const Lane& to);

/// The foot of a place on the lane's centerline; empty where the place is not in the lane, which is half its
/// width to either side, on its level (2 m).
std::optional<Projection> foot_in(const Lane& lane, const Point& place);

/// The cosine between the vehicle's heading and the centerline, where the vehicle drives in the lane; 0 where
/// the vehicle is elsewhere, or crosses the lane at more than 45 degrees.
double ego_alignment(const Lane& lane, const Eigen::Isometry3d& T_map_body);

/// Those on a side of the lane, which is as its points run.
const std::vector<Neighbour>& neighbours(const Lane& lane, Side side);

/// The lanes of one map by their ids, and how they follow one another.
class LaneGraph {
 public:
  /// `map` must outlive this and stay as it is. Linkages to lanes that it does not hold are left out.
  explicit LaneGraph(const LocalMap& map);

  /// The map that this was made of.
  const LocalMap& map() const { return map_; }

  /// Null: the map has no lane of that id.
  const Lane* find(ElementId id) const;

  /// The lane at a place, the nearest where several lanes overlap; null: there is none.
  const Lane* at(const Point& place) const;

  /// The lane that the vehicle drives in, in its sense; of several the one along which it is aligned best.
  /// Empty: the vehicle is in no lane of the map.
  std::optional<LanePosition> own_lane(const Eigen::Isometry3d& T_map_body) const;

  /// Where the map leads on from the end of a lane, in the order of the map's linkages.
  std::vector<Passage> successors(const DirectedLane& lane) const;

  /// The passages ahead, one after the other, over `reach_m` from the beginning of `lane`: at every one the
  /// best for the wished turn, and straight on once that was made. Each lane is walked once at most.
  std::vector<Passage> ahead(const DirectedLane& lane, Linkage::Turn wished, double reach_m) const;

  /// The lane on a side, as it is walked, at a place of the centerline, which is given as it is walked; null:
  /// there is none.
  const Lane* beside(const DirectedLane& lane, Side side, double arc_m) const;

 private:
  const LocalMap& map_;
  std::map<ElementId, const Lane*> lanes_;
};

/// The passage for a wished turn: the one that makes it, else straight on, else any; of equals the likelier
/// one, and none into oncoming traffic where there is another. Null: there are none.
const Passage* best_passage(const std::vector<Passage>& passages, Linkage::Turn wished);

}  // namespace laneloom
