#pragma once

#include <cstddef>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "mapping/markings/pair_history.hpp"

namespace laneloom {

/// A continuous lane boundary, made of one or more instances.
struct LaneBoundary {
  Marking marking;                 ///< has the id of its oldest member
  std::vector<ElementId> members;  ///< ids of the markings that it is made of, ascending
  std::vector<Range> bridged{};    ///< the gaps between them, along the marking
  bool two_way = false;            ///< inferred, on a road from kerb to kerb: there traffic is taken to meet
};

/// Where it is among boundaries in the order of their ids; it has to be there.
std::size_t index_of(const std::vector<LaneBoundary>& boundaries, ElementId id);
const LaneBoundary& boundary_of(const std::vector<LaneBoundary>& boundaries, ElementId id);

/// The same boundary, run through in the other direction.
void reverse(LaneBoundary& boundary);

/// Groups lanelines and roadedges, respectively, whose end points are close and aligned into continuous
/// boundaries (paper, Sec. III-D-1), but those that are known to be separate. Close ends that detections ran
/// through are joined at any angle: round a hairpin or the tip of an island. The nearest ends are joined
/// first, each end once. By ascending id; stoplines are left out.
std::vector<LaneBoundary> lane_boundaries(const std::vector<Marking>& markings, const PairHistories& joints,
                                          const BoundaryConfig& config);

}  // namespace laneloom
