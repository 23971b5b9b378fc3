#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "laneloom/types.hpp"

namespace laneloom {

/// Lanes as Lanelet2 has them, whose topology is in shared elements alone: lanelets beside each other have a
/// way in common, and one that follows another begins with the nodes that the other ends with. All references
/// are indices. Points are in the map frame, in metres.
struct RoadNetwork {
  struct Way {
    enum class Kind : std::uint8_t { laneline, roadedge, stopline, virtual_line };
    Kind kind = Kind::laneline;
    MarkingStyle style = MarkingStyle::unknown;
    std::vector<std::size_t> nodes;       ///< two or more
    double existence_probability = -1.0;  ///< 0..1; -1: not estimated
    double lateral_stddev_m = -1.0;       ///< -1: not estimated
  };
  /// A side runs as the lanelet where `reversed` is false, else against it.
  struct Side {
    std::size_t way = 0;
    bool reversed = false;
  };
  struct Lanelet {
    Side left, right;
    bool one_way = true;                          ///< else its direction is not known
    ElementId lane = kNoElement;                  ///< of the map; none: it is a linkage's
    std::optional<std::size_t> linkage;           ///< index in the map
    Linkage::Turn turn = Linkage::Turn::unknown;  ///< across an intersection; unknown: it lies in none
    ElementStatus status = ElementStatus::confirmed;
    double existence_probability = -1.0;
  };
  struct StopElement {
    std::size_t way = 0;
    std::vector<std::size_t> lanelets;
  };
  std::vector<Point> nodes;
  std::vector<Way> ways;
  std::vector<Lanelet> lanelets;
  std::vector<StopElement> stops;
};

/// The node that a lanelet's side begins or ends with.
inline std::size_t end_node(const RoadNetwork& network, const RoadNetwork::Side& side, bool at_back) {
  const std::vector<std::size_t>& nodes = network.ways[side.way].nodes;
  return at_back != side.reversed ? nodes.back() : nodes.front();
}

}  // namespace laneloom
