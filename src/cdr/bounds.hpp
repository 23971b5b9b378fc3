#pragma once

#include <cstddef>

#include "laneloom/messages.hpp"

namespace laneloom::dds {

/// Takes out of a map what exceeds the bounds of the IDL, and whatever refers to it, so that every id that is
/// referred to stays in the map: of long lists the first elements stay, an element that is too long itself
/// goes as a whole. Returns how many elements went.
std::size_t keep_within_bounds(PublishedMap& map);

/// Likewise of instances.
std::size_t keep_within_bounds(RoadMarkings& markings);

/// Whether keep_within_bounds() would change nothing.
bool within_bounds(const PublishedMap& map);
bool within_bounds(const RoadMarkings& markings);

}  // namespace laneloom::dds
