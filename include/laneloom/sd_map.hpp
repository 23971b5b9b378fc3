#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "laneloom/types.hpp"

namespace laneloom {

/// A street of a standard-definition map, without lanes.
struct SdWay {
  std::int64_t id = 0;
  std::vector<std::int64_t> nodes;      ///< at least two; ways meet where they have one in common
  std::vector<Eigen::Vector2d> points;  ///< of the nodes, map frame
  bool oneway = false;                  ///< in the order of the nodes
};

/// At a node, one may not turn from one way into another, or into no other.
struct SdRestriction {
  std::int64_t from_way = 0, via_node = 0, to_way = 0;
  bool only = false;
};

/// A standard-definition map: which streets lead into which (paper, Sec. III-D-4). Immutable.
class SdMap {
 public:
  SdMap() = default;
  /// Throws std::invalid_argument where a way has not as many points as nodes, or fewer than two.
  SdMap(std::vector<SdWay> ways, const std::vector<SdRestriction>& restrictions);

  /// Whether it has no street.
  bool empty() const { return segments_.empty(); }

  /// The map's verdict on two lanes.
  enum class Verdict {
    unknown,    ///< one of the lanes lies on no street of the map
    connected,  ///< the street of the one leads into that of the other
    forbidden   ///< it does not, or not without breaking a restriction
  };
  /// Whether traffic may drive from the end of one lane to the start of another. Both run with the traffic.
  Verdict verdict(const Polyline& from, const Polyline& to) const;

 private:
  /// From a node of a way to its next one, as it may be driven.
  struct Segment {
    std::size_t way;
    std::int64_t begin, end;  ///< nodes
    Eigen::Vector2d from, to;
  };
  using Cell = std::pair<int, int>;

  void enter_into_cells(std::size_t index);
  const Segment* nearest(const Eigen::Vector2d& point, const Eigen::Vector2d& direction) const;
  bool may_follow(const Segment& segment, const Segment& next) const;

  std::vector<SdWay> ways_;
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<SdRestriction>> restrictions_;  ///< way, node
  std::vector<Segment> segments_;
  std::map<std::int64_t, std::vector<std::size_t>> leaving_;  ///< segments by the node that they begin at
  std::map<Cell, std::vector<std::size_t>> cells_;            ///< segments by place
};

}  // namespace laneloom
