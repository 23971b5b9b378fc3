#include "export/strays.hpp"

#include <algorithm>
#include <map>
#include <vector>

namespace laneloom::exports {
namespace {

using NetworkSide = RoadNetwork::Side;
using NodePair = std::pair<std::size_t, std::size_t>;  // left, right

NodePair nodes_at(const RoadNetwork& network, const DirectedLanelet& directed, bool at_back) {
  const RoadNetwork::Lanelet& lanelet = network.lanelets[directed.lanelet];
  const bool at_its_back = at_back != directed.backwards;
  const std::size_t left = end_node(network, lanelet.left, at_its_back);
  const std::size_t right = end_node(network, lanelet.right, at_its_back);
  return directed.backwards ? NodePair{right, left} : NodePair{left, right};
}

/// Tells which lanelets may follow each other by the map.
class Allowed {
 public:
  explicit Allowed(const LocalMap& map) : map_(map) {
    for (const Linkage& linkage : map.linkages) pairs_.emplace(linkage.from, linkage.to);
  }
  bool operator()(const RoadNetwork& network, DirectedLanelet from, DirectedLanelet to) const {
    if (from.backwards != to.backwards) return false;
    if (from.backwards) std::swap(from, to);
    const RoadNetwork::Lanelet &a = network.lanelets[from.lanelet], &b = network.lanelets[to.lanelet];
    if (a.linkage && b.linkage) return false;
    if (a.linkage) return map_.linkages[*a.linkage].to == b.lane;
    if (b.linkage) return map_.linkages[*b.linkage].from == a.lane;
    return a.lane == b.lane || pairs_.contains({a.lane, b.lane});
  }

 private:
  const LocalMap& map_;
  std::set<std::pair<ElementId, ElementId>> pairs_;
};

/// Gives a side a copy of its way, with an end node of its own.
void own_end(RoadNetwork& network, NetworkSide& side, bool at_back) {
  RoadNetwork::Way way = network.ways[side.way];
  std::size_t& node = at_back != side.reversed ? way.nodes.back() : way.nodes.front();
  const Point position = network.nodes[node];
  network.nodes.push_back(position);
  node = network.nodes.size() - 1;
  network.ways.push_back(std::move(way));
  side.way = network.ways.size() - 1;
}

}  // namespace

std::set<std::pair<DirectedLanelet, DirectedLanelet>> followers(const RoadNetwork& network) {
  std::vector<DirectedLanelet> all;
  for (std::size_t i = 0; i < network.lanelets.size(); ++i) {
    all.push_back({i, false});
    if (!network.lanelets[i].one_way) all.push_back({i, true});
  }
  std::multimap<NodePair, DirectedLanelet> beginning;
  for (const DirectedLanelet& directed : all) beginning.emplace(nodes_at(network, directed, false), directed);
  std::set<std::pair<DirectedLanelet, DirectedLanelet>> pairs;
  for (const DirectedLanelet& directed : all) {
    const auto [first, last] = beginning.equal_range(nodes_at(network, directed, true));
    for (auto next = first; next != last; ++next) pairs.emplace(directed, next->second);
  }
  return pairs;
}

void separate_strays(const LocalMap& map, RoadNetwork& network) {
  const Allowed allowed(map);
  std::set<std::pair<std::size_t, bool>> ends;  // lanelets, and whether at the back
  for (const auto& [from, to] : followers(network))
    if (!allowed(network, from, to)) ends.emplace(from.lanelet, !from.backwards);
  for (const auto& [lanelet, at_back] : ends) own_end(network, network.lanelets[lanelet].left, at_back);
}

}  // namespace laneloom::exports
