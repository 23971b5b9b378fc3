#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "laneloom/types.hpp"

namespace laneloom::exports {

/// Lanes in the form of Lanelet2, where shared elements alone tell the topology. Lanelets beside each other
/// have a way in common. A lanelet that follows another begins with the nodes that the other ends with. All
/// references are indices. Points are in the map frame, in metres.
struct RoadNetwork {
  struct Way {
    enum class Kind : std::uint8_t { laneline, roadedge, stopline, virtual_line };
    Kind kind = Kind::laneline;
    MarkingStyle style = MarkingStyle::unknown;
    std::vector<std::size_t> nodes;       ///< two or more
    double existence_probability = -1.0;  ///< 0..1; -1: not estimated
    double lateral_stddev_m = -1.0;       ///< -1: not estimated
  };
  /// A side of a lanelet. `reversed`: its way runs against the lanelet.
  struct Side {
    std::size_t way = 0;
    bool reversed = false;
  };
  struct Lanelet {
    Side left, right;
    bool one_way = true;                          ///< else its direction is not known
    Lane::Use use = Lane::Use::lane;              ///< of a side strip: no traffic runs there
    ElementId lane = kNoElement;                  ///< lane of the map; kNoElement: it is a linkage's lanelet
    std::optional<std::size_t> linkage;           ///< index in the map's linkages
    Linkage::Turn turn = Linkage::Turn::unknown;  ///< across an intersection; unknown: it is in none
    ElementStatus status = ElementStatus::confirmed;
    double existence_probability = -1.0;

    bool is_side_strip() const { return use != Lane::Use::lane && use != Lane::Use::unknown; }
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

}  // namespace laneloom::exports
