#include "cdr/bounds.hpp"

#include <algorithm>
#include <set>
#include <type_traits>
#include <vector>

#include "Common.h"
#include "base/fields.hpp"

namespace laneloom::dds {
namespace {

bool fits(const Polyline& line) { return line.size() <= msg::MAX_POINTS; }

bool fits(const Marking& marking) {
  return fits(marking.points) && marking.styles.size() <= msg::MAX_STYLES &&
         marking.lateral_stddev_m.size() <= msg::MAX_POINTS;
}

template <class Number>
requires(std::is_arithmetic_v<Number> || std::is_enum_v<Number>) bool fits(Number /*value*/) { return true; }
bool fits(const Stretch& /*range*/) { return true; }
bool fits(const std::vector<Stretch>& ranges) { return ranges.size() <= msg::MAX_RANGES; }

template <HasFields Struct>
bool fits(const Struct& element);

bool fits(const std::vector<Neighbour>& neighbours) {
  return neighbours.size() <= msg::MAX_NEIGHBOURS &&
         std::ranges::all_of(neighbours, [](const Neighbour& beside) { return fits(beside); });
}

template <HasFields Struct>
bool fits(const Struct& element) {
  bool all = true;
  for_each_field<Struct>([&](const auto& field) { all = all && fits(element.*field.member); });
  return all;
}

bool fits(const Stopline& stopline) {
  return fits(stopline.marking) && stopline.lanes.size() <= msg::MAX_STOPLINE_LANES;
}

bool fits(const FusedFrame& /*frame*/) { return true; }
bool fits(const LineageEvent& /*event*/) { return true; }

template <class T>
bool within(const std::vector<T>& list, std::size_t bound) {
  return list.size() <= bound && std::all_of(list.begin(), list.end(), [](const T& e) { return fits(e); });
}

/// Keeps the first `bound` elements that `keep` accepts. Returns how many were removed.
template <class T, class Keep>
std::size_t prune(std::vector<T>& list, std::size_t bound, Keep keep) {
  const auto before = list.size();
  std::erase_if(list, [&](const T& element) { return !keep(element); });
  if (list.size() > bound) list.resize(bound);
  return before - list.size();
}

template <class T>
std::size_t prune(std::vector<T>& list, std::size_t bound) {
  return prune(list, bound, [](const T& element) { return fits(element); });
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
  return within(map.reasons, msg::MAX_REASONS) && within(map.fused_frames, msg::MAX_FRAMES) &&
         within(m.boundaries, msg::MAX_MARKINGS) && within(m.lanes, msg::MAX_LANES) &&
         within(m.stoplines, msg::MAX_MARKINGS) && within(m.linkages, msg::MAX_LINKAGES) &&
         within(m.lineage, msg::MAX_LINKAGES);
}

bool within_bounds(const RoadMarkings& markings) { return within(markings.markings, msg::MAX_MARKINGS); }

std::size_t keep_within_bounds(RoadMarkings& markings) { return prune(markings.markings, msg::MAX_MARKINGS); }

std::size_t keep_within_bounds(PublishedMap& map) {
  auto& m = map.map;
  std::size_t gone = prune(map.reasons, msg::MAX_REASONS) + prune(map.fused_frames, msg::MAX_FRAMES) +
                     prune(m.lineage, msg::MAX_LINKAGES) + prune(m.boundaries, msg::MAX_MARKINGS);

  const auto boundaries = ids_of(m.boundaries);
  gone += prune(m.lanes, msg::MAX_LANES, [&](const Lane& lane) {
    return fits(lane) && boundaries.contains(lane.left_boundary) && boundaries.contains(lane.right_boundary);
  });
  const auto lanes = ids_of(m.lanes);
  for (auto& lane : m.lanes) {
    for (auto* neighbours : {&lane.left_neighbours, &lane.right_neighbours})
      std::erase_if(*neighbours, [&](const Neighbour& beside) { return !lanes.contains(beside.lane); });
  }
  for (auto& stopline : m.stoplines) {
    std::erase_if(stopline.lanes, [&](ElementId lane) { return !lanes.contains(lane); });
  }
  gone += prune(m.stoplines, msg::MAX_MARKINGS);
  gone += prune(m.linkages, msg::MAX_LINKAGES, [&](const Linkage& linkage) {
    return fits(linkage) && lanes.contains(linkage.from) && lanes.contains(linkage.to);
  });
  return gone;
}

}  // namespace laneloom::dds
