#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "Common.hpp"
#include "base/fields.hpp"

namespace laneloom::dds {

/// The bound of the IDL for lists of such elements, the same wherever there is such a list.
///@{
constexpr std::size_t max_length(const Point*) { return msg::MAX_POINTS; }
constexpr std::size_t max_length(const double*) { return msg::MAX_POINTS; }
constexpr std::size_t max_length(const Polyline*) { return msg::MAX_AREAS; }
constexpr std::size_t max_length(const MarkingType*) { return msg::MAX_TYPES; }
constexpr std::size_t max_length(const Detection*) { return msg::MAX_MARKINGS; }
constexpr std::size_t max_length(const StateReason*) { return msg::MAX_REASONS; }
constexpr std::size_t max_length(const FusedFrame*) { return msg::MAX_FRAMES; }
constexpr std::size_t max_length(const StyleRange*) { return msg::MAX_STYLES; }
constexpr std::size_t max_length(const Marking*) { return msg::MAX_MARKINGS; }
constexpr std::size_t max_length(const Stretch*) { return msg::MAX_RANGES; }
constexpr std::size_t max_length(const Neighbour*) { return msg::MAX_NEIGHBOURS; }
constexpr std::size_t max_length(const Border*) { return msg::MAX_BORDERS; }
constexpr std::size_t max_length(const Lane*) { return msg::MAX_LANES; }
constexpr std::size_t max_length(const ElementId*) { return msg::MAX_STOPLINE_LANES; }
constexpr std::size_t max_length(const Stopline*) { return msg::MAX_MARKINGS; }
constexpr std::size_t max_length(const Linkage*) { return msg::MAX_LINKAGES; }
constexpr std::size_t max_length(const WayStation*) { return msg::MAX_WAY_STATIONS; }
constexpr std::size_t max_length(const WayLane*) { return msg::MAX_WAY_LANES; }
constexpr std::size_t max_length(const DrivenPath*) { return msg::MAX_DRIVEN_PATHS; }
constexpr std::size_t max_length(const TrackedObject*) { return msg::MAX_OBJECTS; }
constexpr std::size_t max_length(const LineageEvent*) { return msg::MAX_LINKAGES; }
///@}
template <class Element>
inline constexpr std::size_t kMaxLength = max_length(static_cast<const Element*>(nullptr));

/// Whether all lists within a value are within the bounds of the IDL.
///@{
template <class Element>
bool fits(const std::vector<Element>& list);
template <class Value>
bool fits(const std::optional<Value>& value);
template <class Value>
bool fits(const Value& value) {
  bool all = true;
  if constexpr (HasFields<Value>)
    for_each_field<Value>([&](const auto& field) { all = all && fits(value.*field.member); });
  return all;
}
template <class Element>
bool fits(const std::vector<Element>& list) {
  return list.size() <= kMaxLength<Element> &&
         std::ranges::all_of(list, [](const Element& element) { return fits(element); });
}
template <class Value>
bool fits(const std::optional<Value>& value) {
  return !value || fits(*value);
}
///@}

/// Removes from a map the elements that exceed the bounds of the IDL, and all that refer to them, so that
/// every id that is referred to stays in the map. Of a list that is too long, the first elements stay. An
/// element that is too long itself is removed as a whole, and so is a way through a lane that is. Returns how
/// many elements were removed.
std::size_t keep_within_bounds(PublishedMap& map);

/// Does the same for the topic road_markings.
std::size_t keep_within_bounds(RoadMarkings& markings);

/// Whether keep_within_bounds() would change nothing.
bool within_bounds(const PublishedMap& map);
bool within_bounds(const RoadMarkings& markings);

}  // namespace laneloom::dds
