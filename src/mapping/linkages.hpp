#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"

namespace laneloom {

/// Which lane continues which, outside of intersections (paper, Sec. III-D-4): the next lane along a shared
/// boundary, and lanes whose ends are aligned. Each pair once, a shared boundary before an alignment; by
/// ascending ids.
std::vector<Linkage> generate_linkages(const std::vector<Lane>& lanes, const LinkageConfig& config);

}  // namespace laneloom
