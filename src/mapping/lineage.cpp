#include "mapping/lineage.hpp"

#include <algorithm>
#include <set>

namespace laneloom {
namespace {

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

std::set<ElementId> elements(const Membership& membership) {
  std::set<ElementId> ids;
  for (const auto& [marking, element] : membership) ids.insert(element);
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
  const std::set<ElementId> ids_before = elements(before), ids_now = elements(now);
  std::vector<LineageEvent> events;
  // An element has the id of its oldest marking, and shares that marking's fate.
  for (const ElementId id : ids_now) {
    if (ids_before.contains(id)) continue;
    const ElementId former = element_of(before, id, relatives);
    events.push_back({former == kNoElement ? Kind::born : Kind::split_from, id, former});
  }
  for (const ElementId id : ids_before) {
    if (ids_now.contains(id)) continue;
    const ElementId heir = element_of(now, id, relatives);
    events.push_back({heir == kNoElement ? Kind::retired : Kind::merged_into, id, heir});
  }
  std::ranges::stable_sort(events, {}, &LineageEvent::id);
  return events;
}

}  // namespace laneloom
