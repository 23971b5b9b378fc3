#include "evaluation/lane_chains.hpp"

#include <map>
#include <set>

#include "laneloom/polyline.hpp"

namespace laneloom::evaluation {
namespace {

using Next = std::map<ElementId, ElementId>;
using Chain = std::vector<ElementId>;

/// The chain from `first` on, of lanes that are in no chain yet.
Chain chain_from(ElementId first, const Next& next, std::set<ElementId>& used) {
  Chain chain;
  for (ElementId id = first; used.insert(id).second;) {
    chain.push_back(id);
    const auto after = next.find(id);
    if (after == next.end()) break;
    id = after->second;
  }
  return chain;
}

template <class Lanes>
std::vector<Chain> chains(const Lanes& lanes, const Next& next) {
  std::set<ElementId> continuing, used;
  for (const auto& [from, to] : next) continuing.insert(to);
  std::vector<Chain> chains;
  for (const auto& [id, lane] : lanes)
    if (!continuing.contains(id)) chains.push_back(chain_from(id, next, used));
  for (const auto& [id, lane] : lanes)  // the remaining lanes form rings
    if (!used.contains(id)) chains.push_back(chain_from(id, next, used));
  return chains;
}

bool can_be_seen(const simulation::RoadLane& lane) {
  const bool is_marked = lane.left_marking != kNoElement || lane.right_marking != kNoElement;
  return is_marked && !lane.in_intersection;
}

using Links = std::map<ElementId, const Linkage*>;  ///< by the lane from which they lead

/// Sets the id and the existence probability of a chain.
void summarise(PublishedChain& chain) {
  double longest_m = -1.0, told_m = 0.0, sum_m = 0.0;
  for (const Lane* lane : chain.lanes) {
    const double length_m = length(lane->centerline);
    if (length_m > longest_m) {
      longest_m = length_m;
      chain.id = lane->id;
    }
    if (lane->existence_probability < 0.0) continue;
    told_m += length_m;
    sum_m += length_m * lane->existence_probability;
  }
  if (told_m > 0.0) chain.existence_probability = sum_m / told_m;
}

/// The linkages by which one lane only continues another.
Links continuations(const LocalMap& map) {
  std::map<ElementId, int> leaving, entering;
  for (const Linkage& linkage : map.linkages) {
    ++leaving[linkage.from];
    ++entering[linkage.to];
  }
  Links links;
  for (const Linkage& linkage : map.linkages) {
    const bool by_markings =
        linkage.kind == Linkage::Kind::shared_boundary || linkage.kind == Linkage::Kind::geometric_alignment;
    if (by_markings && leaving[linkage.from] == 1 && entering[linkage.to] == 1)
      links.emplace(linkage.from, &linkage);
  }
  return links;
}

}  // namespace

std::vector<LaneChain> lane_chains(const simulation::Road& truth) {
  std::map<ElementId, int> entries;
  std::map<ElementId, const simulation::RoadLane*> lanes;
  for (const simulation::RoadLane& lane : truth.lanes) {
    for (const ElementId next : lane.successors) ++entries[next];
    if (can_be_seen(lane)) lanes.emplace(lane.id, &lane);
  }
  Next next;
  for (const auto& [id, lane] : lanes) {
    if (lane->successors.size() != 1 || entries[lane->successors.front()] != 1) continue;
    if (lanes.contains(lane->successors.front())) next.emplace(id, lane->successors.front());
  }
  std::vector<LaneChain> result;
  for (const Chain& chain : chains(lanes, next)) {
    LaneChain& members = result.emplace_back();
    for (const ElementId id : chain) members.push_back(lanes.at(id));
  }
  return result;
}

Polyline centerline(const LaneChain& chain) {
  Polyline points;
  for (const simulation::RoadLane* lane : chain)
    points.insert(points.end(), lane->centerline.begin(), lane->centerline.end());
  return points;
}

std::vector<PublishedChain> lane_chains(const LocalMap& map) {
  std::map<ElementId, const Lane*> lanes;
  for (const Lane& lane : map.lanes) lanes.emplace(lane.id, &lane);
  const Links links = continuations(map);
  Next next;
  for (const auto& [from, linkage] : links)
    if (lanes.contains(from) && lanes.contains(linkage->to)) next.emplace(from, linkage->to);
  std::vector<PublishedChain> result;
  for (const Chain& chain : chains(lanes, next)) {
    PublishedChain& published = result.emplace_back();
    const auto append = [&](const Polyline& points) {
      published.centerline.insert(published.centerline.end(), points.begin(), points.end());
    };
    for (const ElementId id : chain) {
      if (!published.lanes.empty()) append(links.at(published.lanes.back()->id)->path);
      published.lanes.push_back(lanes.at(id));
      append(lanes.at(id)->centerline);
    }
    summarise(published);
  }
  return result;
}

}  // namespace laneloom::evaluation
