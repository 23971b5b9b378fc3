#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/polyline.hpp"
#include "laneloom/types.hpp"
#include "mapping/boundaries/lane_boundaries.hpp"

namespace laneloom {

/// Which lane continues which, outside of intersections (paper, Sec. III-D-4): the next lane along a shared
/// boundary, and lanes whose ends are aligned. Each pair once, a shared boundary before an alignment; by
/// ascending ids. Across a gap, the path keeps beside the shared boundary (ours): round a corner, that is
/// where the traffic turns. The lanes' ids of boundaries are among `boundaries`; `measured` is parallel to
/// it.
std::vector<Linkage> generate_linkages(const std::vector<Lane>& lanes,
                                       const std::vector<LaneBoundary>& boundaries,
                                       const std::vector<MeasuredPolyline>& measured,
                                       const LinkageConfig& config);

}  // namespace laneloom
