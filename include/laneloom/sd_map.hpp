#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "laneloom/types.hpp"

namespace laneloom {

/// A street of a standard-definition map, without lanes.
struct SdWay {
  std::int64_t id = 0;                  ///< as restrictions name it
  std::vector<std::int64_t> nodes;      ///< at least two; ways meet where they have one in common
  std::vector<Eigen::Vector2d> points;  ///< of the nodes, map frame
  bool oneway = false;                  ///< in the order of the nodes
  int lanes = 0;                        ///< of both directions together; 0: not known
};

/// A restriction at a node: traffic from one way may not turn into another way, or into no other (`only`).
struct SdRestriction {
  std::int64_t from_way = 0, via_node = 0, to_way = 0;  ///< ids
  bool only = false;  ///< `to_way` is the only way that may be entered; else it may not be entered
};

/// A standard-definition map: which streets lead into which (paper, Sec. III-D-4), which are one-way streets,
/// and how many lanes they have. Immutable.
class SdMap {
 public:
  SdMap() = default;
  /// Throws std::invalid_argument where a way has not as many points as nodes, or fewer than two.
  SdMap(std::vector<SdWay> ways, const std::vector<SdRestriction>& restrictions);

  /// Whether the map has no street.
  bool empty() const { return segments_.empty(); }

  /// The map's verdict on two lanes.
  enum class Verdict {
    unknown,    ///< one of the lanes lies on no street of the map
    connected,  ///< the street of the one leads into that of the other
    forbidden   ///< it does not lead there, or only by breaking a restriction
  };
  /// Whether traffic may drive from the end of lane `from` to the start of lane `to`. Both are centerlines in
  /// the map frame, in the direction of traffic.
  Verdict verdict(const Polyline& from, const Polyline& to) const;

  /// Which way traffic runs on the streets around a place: all that are at most 15 m away and run along
  /// `direction` or against it, by 37 degrees. 1: along it; -1: against it; 0: either way, or there is no
  /// street. `direction` has unit length. Map frame.
  int one_way_at(const Eigen::Vector2d& place, const Eigen::Vector2d& direction) const;

  /// How many lanes the street at a place has, of both directions together. 0: the streets around it, as for
  /// one_way_at(), do not all tell the same number; or traffic of either direction has one-way streets of its
  /// own, whose lanes the place may lie beside. `direction` has unit length. Map frame.
  int lanes_at(const Eigen::Vector2d& place, const Eigen::Vector2d& direction) const;

  /// A place in the middle of a street, and the direction in which traffic drives on from there.
  struct Place {
    Eigen::Vector2d point, direction;
  };
  /// The place beside `place` on the nearest street that traffic may drive along `direction`, by 37 degrees.
  /// Empty: none is at most 15 m away. `direction` has unit length. Map frame.
  std::optional<Place> beside(const Eigen::Vector2d& place, const Eigen::Vector2d& direction) const;
  /// The line of that street from this place on, over `length_m`. It ends earlier where the street ends, and
  /// at a junction from which no street, or more than one, leads on within 45 degrees. Empty: there is no
  /// street. Heights are 0.
  Polyline onward(const Eigen::Vector2d& place, const Eigen::Vector2d& direction, double length_m) const;

 private:
  /// A piece of a way from one node to the next, in a direction in which it may be driven.
  struct Segment {
    std::size_t way;           ///< place in ways_
    std::int64_t begin, end;   ///< nodes
    Eigen::Vector2d from, to;  ///< places of these nodes, map frame
  };
  using Cell = std::pair<int, int>;

  void enter_into_cells(std::size_t index);
  template <class Visit>
  void visit_around(const Eigen::Vector2d& place, const Eigen::Vector2d& direction, Visit&& visit) const;
  const Segment* nearest(const Eigen::Vector2d& point, const Eigen::Vector2d& direction) const;
  bool may_follow(const Segment& segment, const Segment& next) const;
  const Segment* straight_on(const Segment& segment) const;

  std::vector<SdWay> ways_;
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<SdRestriction>> restrictions_;  ///< way, node
  std::vector<Segment> segments_;
  std::map<std::int64_t, std::vector<std::size_t>> leaving_;  ///< segments by the node that they begin at
  std::map<Cell, std::vector<std::size_t>> cells_;            ///< segments by place
};

}  // namespace laneloom
