#pragma once

#include <cstddef>

#include "laneloom/messages.hpp"

namespace laneloom::dds {

/// Removes from a map the elements that exceed the bounds of the IDL, and all that refer to them, so that
/// every id that is referred to stays in the map. Of a list that is too long, the first elements stay. An
/// element that is too long itself is removed as a whole. Returns how many elements were removed.
std::size_t keep_within_bounds(PublishedMap& map);

/// Does the same for the topic road_markings.
std::size_t keep_within_bounds(RoadMarkings& markings);

/// Whether keep_within_bounds() would change nothing.
bool within_bounds(const PublishedMap& map);
bool within_bounds(const RoadMarkings& markings);

}  // namespace laneloom::dds
