#include "export/road_links.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "export/strays.hpp"

namespace laneloom::exports {

RoadLinks::RoadLinks(const RoadNetwork& network, const std::vector<Carriageway>& roads)
    : ends_(2 * roads.size()) {
  for (std::size_t road = 0; road < roads.size(); ++road) {
    before_[road] = behind_[road] = {};
    int lane = 0;
    for (const std::size_t lanelet : roads[road].lanelets) places_[lanelet] = {road, --lane};
  }
  for (const auto& [from, to] : followers(network)) {
    const auto here = places_.find(from.lanelet), there = places_.find(to.lanelet);
    if (from.backwards || to.backwards || here == places_.end() || there == places_.end()) continue;
    behind_[here->second.road].insert(there->second.road);
    before_[there->second.road].insert(here->second.road);
    lanes_[{here->second.road, there->second.road}].emplace_back(here->second.lane, there->second.lane);
  }
  find_connecting(network, roads);
  std::iota(ends_.begin(), ends_.end(), std::size_t{0});
  for (const std::size_t road : connecting_)
    ends_[root(end_of(*before_[road].begin(), true))] = root(end_of(*behind_[road].begin(), false));
  for (const std::size_t road : connecting_) roots_.insert(root(end_of(*before_[road].begin(), true)));
}

void RoadLinks::find_connecting(const RoadNetwork& network, const std::vector<Carriageway>& roads) {
  const auto is_linkage = [&](std::size_t lanelet) { return network.lanelets[lanelet].linkage.has_value(); };
  for (std::size_t road = 0; road < roads.size(); ++road) {
    if (before_[road].size() != 1 || behind_[road].size() != 1) continue;
    const bool parts = behind_[*before_[road].begin()].size() > 1;
    const bool joins = before_[*behind_[road].begin()].size() > 1;
    if (parts || joins || std::ranges::all_of(roads[road].lanelets, is_linkage)) connecting_.insert(road);
  }
  // A connecting road leads from a road that is none to another such road.
  const std::set<std::size_t> candidates = connecting_;
  std::erase_if(connecting_, [&](std::size_t road) {
    return candidates.contains(*before_[road].begin()) || candidates.contains(*behind_[road].begin());
  });
}

std::size_t RoadLinks::root(std::size_t end) const {
  while (ends_[end] != end) end = ends_[end];
  return end;
}

std::optional<std::size_t> RoadLinks::number_of(std::size_t end) const {
  const auto found = roots_.find(root(end));
  if (found == roots_.end()) return std::nullopt;
  return ends_.size() / 2 + static_cast<std::size_t>(std::distance(roots_.begin(), found));
}

std::optional<std::size_t> RoadLinks::linked(std::size_t road, bool behind) const {
  const std::set<std::size_t>& there = (behind ? behind_ : before_).at(road);
  if (there.size() != 1) return std::nullopt;
  const std::size_t other = *there.begin();
  const bool alone = (behind ? before_ : behind_).at(other).size() == 1;
  return connecting_.contains(road) || alone ? std::optional(other) : std::nullopt;
}

std::optional<std::size_t> RoadLinks::junction_at(std::size_t road, bool behind) const {
  return connecting_.contains(road) ? std::nullopt : number_of(end_of(road, behind));
}

std::optional<std::size_t> RoadLinks::junction_of(std::size_t road) const {
  return connecting_.contains(road) ? number_of(end_of(*before_.at(road).begin(), true)) : std::nullopt;
}

std::map<std::size_t, std::vector<std::pair<std::size_t, std::size_t>>> RoadLinks::junctions() const {
  std::map<std::size_t, std::vector<std::pair<std::size_t, std::size_t>>> result;
  for (const std::size_t road : connecting_)
    result[*junction_of(road)].emplace_back(road, *before_.at(road).begin());
  return result;
}

std::optional<std::size_t> RoadLinks::road_of(std::size_t lanelet) const {
  const auto found = places_.find(lanelet);
  return found == places_.end() ? std::nullopt : std::optional(found->second.road);
}

}  // namespace laneloom::exports
