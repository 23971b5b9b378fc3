#include "mapping/lineage.hpp"

#include <algorithm>
#include <vector>

#include "laneloom/polyline.hpp"
#include "mapping/lanes/lane_geometry.hpp"

namespace laneloom {
namespace {

constexpr double kSameLane_m = 1.0;  // between the centerlines; less than half the width of a lane

/// The element that a marking belongs to. kNoElement: the marking is not published.
ElementId element_of(const Membership& membership, ElementId marking) {
  const auto found = std::ranges::lower_bound(membership, marking, {}, &Membership::value_type::first);
  return found != membership.end() && found->first == marking ? found->second : kNoElement;
}

/// The element of a marking, or else that of its nearest relative that has one. Relatives are followed on,
/// because a line may have merged into a line that merged into another one later.
ElementId element_of(const Membership& membership, ElementId marking,
                     const std::vector<markings::Relative>& relatives) {
  for (auto relative = relatives.begin(); relative != relatives.end(); ++relative) {
    if (relative->id != marking) continue;
    if (const ElementId element = element_of(membership, marking); element != kNoElement) return element;
    marking = relative->other;
  }
  return element_of(membership, marking);
}

bool is_in(const std::vector<Lane>& lanes, ElementId id) {
  return std::ranges::find(lanes, id, &Lane::id) != lanes.end();
}

/// The lane beside whose centerline most of another one lies, at least half. kNoElement: there is none.
ElementId lane_beside(const Lane& lane, const std::vector<Lane>& lanes) {
  const lanes::Box near = lanes::box_around(lane.centerline, kSameLane_m);
  ElementId nearest = kNoElement;
  std::size_t most = (lane.centerline.size() + 1) / 2;
  for (const Lane& other : lanes) {
    if (!near.intersects(lanes::box_around(other.centerline))) continue;
    const std::size_t beside =
        lanes::points_beside(lane.centerline, MeasuredPolyline(other.centerline), kSameLane_m);
    if (beside < most) continue;
    nearest = other.id;
    most = beside + 1;
  }
  return nearest;
}

/// The ids of the elements, each once, in ascending order.
std::vector<ElementId> elements(const Membership& membership) {
  std::vector<ElementId> ids;
  ids.reserve(membership.size());
  for (const auto& [marking, element] : membership) ids.push_back(element);
  std::ranges::sort(ids);
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

}  // namespace

Membership membership(const boundaries::Boundaries& boundaries, const std::vector<Stopline>& stoplines) {
  Membership result;
  for (const boundaries::LaneBoundary& boundary : boundaries) {
    for (const ElementId member : boundary.members) result.emplace_back(member, boundary.marking.id);
  }
  for (const Stopline& stopline : stoplines) result.emplace_back(stopline.marking.id, stopline.marking.id);
  std::ranges::sort(result);
  return result;
}

std::vector<LineageEvent> lineage(const Membership& before, const Membership& now,
                                  const std::vector<markings::Relative>& relatives) {
  using Kind = LineageEvent::Kind;
  const std::vector<ElementId> ids_before = elements(before), ids_now = elements(now);
  std::vector<LineageEvent> events;
  // An element has the id of its oldest marking, and shares that marking's fate.
  for (const ElementId id : ids_now) {
    if (std::ranges::binary_search(ids_before, id)) continue;
    const ElementId former = element_of(before, id, relatives);
    events.push_back(
        {.kind = former == kNoElement ? Kind::born : Kind::split_from, .id = id, .other = former});
  }
  for (const ElementId id : ids_before) {
    if (std::ranges::binary_search(ids_now, id)) continue;
    const ElementId heir = element_of(now, id, relatives);
    events.push_back(
        {.kind = heir == kNoElement ? Kind::retired : Kind::merged_into, .id = id, .other = heir});
  }
  std::ranges::stable_sort(events, {}, &LineageEvent::id);
  return events;
}

void mark_stoplines(const std::vector<Stopline>& stoplines, std::vector<LineageEvent>& events) {
  const auto id_of = [](const Stopline& stopline) { return stopline.marking.id; };
  for (LineageEvent& event : events)
    if (std::ranges::find(stoplines, event.id, id_of) != stoplines.end())
      event.element = LineageEvent::Element::stopline;
}

std::vector<LineageEvent> lane_lineage(const std::vector<Lane>& before, const std::vector<Lane>& now) {
  using Kind = LineageEvent::Kind;
  std::vector<LineageEvent> events;
  const auto add = [&](Kind alone, Kind related, const Lane& lane, const std::vector<Lane>& others) {
    const ElementId other = lane_beside(lane, others);
    events.push_back({other == kNoElement ? alone : related, LineageEvent::Element::lane, lane.id, other});
  };
  for (const Lane& lane : now)
    if (!is_in(before, lane.id)) add(Kind::born, Kind::split_from, lane, before);
  for (const Lane& lane : before)
    if (!is_in(now, lane.id)) add(Kind::retired, Kind::merged_into, lane, now);
  std::ranges::stable_sort(events, {}, &LineageEvent::id);
  return events;
}

}  // namespace laneloom
