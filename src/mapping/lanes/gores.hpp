#pragma once

#include <vector>

#include "mapping/lanes/cross_sections.hpp"

namespace laneloom::lanes {

/// Makes the cross-sections of a gore invalid. A gore is the wedge between two borders that meet, or would
/// meet not far beyond where they are seen: there roads split or join. It ends where one of the two borders
/// may be crossed. Sections in which the vehicle drives are no gore. Ours.
void remove_gores(const LaneBorder& left, const LaneBorder& right, const Point& vehicle,
                  std::vector<CrossSection>& sections);

}  // namespace laneloom::lanes
