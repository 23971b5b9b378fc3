#include "cdr/bounds.hpp"

#include <algorithm>
#include <set>
#include <vector>

namespace laneloom::dds {
namespace {

/// Keeps the first elements that fit and that `keep` accepts, as many as the IDL allows. Returns how many
/// were removed.
template <class T, class Keep>
std::size_t prune(std::vector<T>& list, Keep keep) {
  const auto before = list.size();
  std::erase_if(list, [&](const T& element) { return !fits(element) || !keep(element); });
  if (list.size() > kMaxLength<T>) list.resize(kMaxLength<T>);
  return before - list.size();
}

template <class T>
std::size_t prune(std::vector<T>& list) {
  return prune(list, [](const T&) { return true; });
}

template <class T>
std::set<ElementId> ids_of(const std::vector<T>& elements) {
  std::set<ElementId> ids;
  for (const auto& element : elements) ids.insert(element.id);
  return ids;
}

}  // namespace

bool within_bounds(const PublishedMap& map) {
  const auto& m = map.map;
  return fits(map.reasons) && fits(map.fused_frames) && fits(m.boundaries) && fits(m.lanes) &&
         fits(m.stoplines) && fits(m.linkages) && fits(m.way) && fits(m.driven_paths) && fits(m.lineage);
}

bool within_bounds(const RoadMarkings& markings) { return fits(markings.markings); }

std::size_t keep_within_bounds(RoadMarkings& markings) { return prune(markings.markings); }

std::size_t keep_within_bounds(PublishedMap& map) {
  auto& m = map.map;
  std::size_t gone = prune(map.reasons) + prune(map.fused_frames) + prune(m.lineage) + prune(m.boundaries);

  const auto boundaries = ids_of(m.boundaries);
  const auto is_there = [&](const Border& border) {
    return border.boundary == kNoElement || boundaries.contains(border.boundary);
  };
  gone += prune(m.lanes, [&](const Lane& lane) {
    return std::ranges::all_of(lane.left_borders, is_there) &&
           std::ranges::all_of(lane.right_borders, is_there);
  });
  const auto lanes = ids_of(m.lanes);
  for (auto& lane : m.lanes) {
    for (auto* neighbours : {&lane.left_neighbours, &lane.right_neighbours})
      std::erase_if(*neighbours, [&](const Neighbour& beside) { return !lanes.contains(beside.lane); });
  }
  for (auto& stopline : m.stoplines) {
    std::erase_if(stopline.lanes, [&](ElementId lane) { return !lanes.contains(lane); });
  }
  gone += prune(m.stoplines);
  gone += prune(m.linkages, [&](const Linkage& linkage) {
    return lanes.contains(linkage.from) && lanes.contains(linkage.to);
  });
  gone += prune(m.driven_paths);
  const auto in_map = [&](const WayLane& lane) { return lanes.contains(lane.id); };
  if (m.way && !(fits(*m.way) && std::ranges::all_of(m.way->lanes, in_map))) {
    m.way.reset();
    ++gone;
  }
  return gone;
}

}  // namespace laneloom::dds
