#pragma once

#include <vector>

#include "mapping/lanes/cross_sections.hpp"

namespace laneloom {

/// Takes out the cross-sections of a gore, where roads split or join: the space between two borders that meet
/// at one of its ends, or that would if they were seen as far, from there to where one of the two may be
/// crossed. What the vehicle drives in is none. Ours.
void remove_gores(const LaneBorder& left, const LaneBorder& right, const Point& vehicle,
                  std::vector<CrossSection>& sections);

}  // namespace laneloom
