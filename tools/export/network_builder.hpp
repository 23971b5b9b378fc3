#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <utility>

#include "export/gates.hpp"
#include "export/node_groups.hpp"
#include "export/road_network.hpp"

namespace laneloom::exports {

/// Makes the nodes and ways of a network out of cuts. Each node and each way is made once, however many
/// lanelets share it. The constructor's arguments must outlive it.
class NetworkBuilder {
 public:
  using Side = RoadNetwork::Side;

  NetworkBuilder(const LocalMap& map, const Gates& gates, NodeGroups& groups);

  /// The stretch of a boundary between two different cuts on it, as a side from the one to the other.
  Side stretch(std::size_t from, std::size_t to);
  /// The sides of a lanelet from gate to gate beside a path (empty: straight). A side is a stretch of a
  /// boundary if both cuts are on it and it leads there, or else a virtual line.
  std::pair<Side, Side> sides_between(const Gates::Gate& from, const Gates::Gate& to, const Polyline& path);
  /// A way for a marking by itself. Returns its index.
  std::size_t free_way(const Marking& marking);
  /// The last lanelet of a lane, which must have one.
  std::size_t last_of(ElementId lane) const { return last_.at(lane); }

  void add(const RoadNetwork::Lanelet& lanelet);
  void add(RoadNetwork::StopElement stop) { network_.stops.push_back(std::move(stop)); }
  /// Adds the stretches of boundaries that were seen and bound no lane.
  void add_rest();
  RoadNetwork take() { return std::move(network_); }

 private:
  std::size_t node_of(std::size_t cut);
  std::size_t add_node(const Point& point);
  RoadNetwork::Way way_on(std::size_t boundary, const Stretch& range) const;
  std::size_t way_between(std::size_t from, std::size_t to);
  Side virtual_side(std::size_t from, std::size_t to, const Polyline& middle, double from_m, double to_m);
  void add_end(std::size_t boundary, const Stretch& range, std::size_t cut);

  const LocalMap& map_;
  const Gates& gates_;
  NodeGroups& groups_;
  RoadNetwork network_;
  std::map<std::size_t, std::size_t> nodes_;                         // by group of cuts
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> ways_;  // by cuts, in the order of their arcs
  std::map<ElementId, std::size_t> last_;
};

}  // namespace laneloom::exports
