#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "export/carriageways.hpp"

namespace laneloom::exports {

/// How the carriageways of a network follow one another, as roads of OpenDRIVE: with the lanes -1, -2, … from
/// left to right. Roads and junctions have one row of numbers, roads first.
class RoadLinks {
 public:
  RoadLinks(const RoadNetwork& network, const std::vector<Carriageway>& roads);

  /// Pairs of lanes of two roads of which one follows the other.
  using LaneLinks = std::vector<std::pair<int, int>>;
  const LaneLinks& lanes(std::size_t from, std::size_t to) const { return lanes_.at({from, to}); }
  /// The road before or behind a road: it is alone there, and neither road has another one at that joint. Of
  /// a connecting road, the one that it comes from or leads to.
  std::optional<std::size_t> linked(std::size_t road, bool behind) const;
  /// The junction before or behind a road that is no connecting road.
  std::optional<std::size_t> junction_at(std::size_t road, bool behind) const;
  /// The junction that a connecting road is in. None: it is no connecting road.
  std::optional<std::size_t> junction_of(std::size_t road) const;
  /// The connecting roads, and the road that each comes from, by junction.
  std::map<std::size_t, std::vector<std::pair<std::size_t, std::size_t>>> junctions() const;
  /// The road that a lanelet is in.
  std::optional<std::size_t> road_of(std::size_t lanelet) const;

 private:
  struct Place {
    std::size_t road = 0;
    int lane = 0;
  };
  using Roads = std::map<std::size_t, std::set<std::size_t>>;

  static std::size_t end_of(std::size_t road, bool behind) { return 2 * road + (behind ? 1 : 0); }
  std::size_t root(std::size_t end) const;
  void find_connecting(const RoadNetwork& network, const std::vector<Carriageway>& roads);
  std::optional<std::size_t> number_of(std::size_t end) const;

  std::map<std::size_t, Place> places_;  ///< of lanelets
  Roads before_, behind_;                ///< roads, by road
  std::map<std::pair<std::size_t, std::size_t>, LaneLinks> lanes_;
  std::set<std::size_t> connecting_;
  std::vector<std::size_t> ends_;  ///< of roads; those of one junction lead to one root
  std::set<std::size_t> roots_;    ///< that are junctions
};

}  // namespace laneloom::exports
