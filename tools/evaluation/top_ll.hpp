#pragma once

#include <vector>

#include "evaluation/evaluation.hpp"
#include "evaluation/linkages.hpp"

/// OpenLane-V2's TOP_ll (Wang et al. 2023; development kit 2.1, openlanev2/centerline/evaluation). It rates
/// the graph of lanes.
///
/// Lanes of truth and map are joined where they only continue one another, clipped to the range (the longest
/// piece counts) and resampled to 11 points. At each threshold of 1, 2 and 3 m of discrete Fréchet distance,
/// the published lanes by descending confidence may each take their nearest truth lane. A vertex is a truth
/// lane, an edge leads to a successor; edges of confidence 0.5 or less do not count. For every vertex, of
/// outgoing and of incoming edges apart, the average precision of the published edges; 1 where there are none
/// and should be none. As in the development kit, an edge that could not be published, since one of its lanes
/// was not found, is taken as wrongly told: harsh on lanes that were missed. TOP_ll is the mean over
/// vertices, directions, frames and thresholds.
///
/// A published lane that runs against its centerline is turned before; one of unknown direction may match in
/// either sense. The linkages between two turned lanes turn with them.
namespace laneloom::evaluation {

/// Sums over vertices, directions, frames and thresholds. Their mean is TOP_ll.
struct TopLl {
  double average_precisions = 0.0;  ///< summed
  std::size_t vertices = 0;         ///< in each frame, threshold and direction

  double value() const { return vertices == 0 ? 0.0 : average_precisions / static_cast<double>(vertices); }
};

/// Discrete Fréchet distance, horizontal.
double frechet_distance_m(const Polyline& a, const Polyline& b);

/// Adds the frame of `map`, whose kind_lines() were compared with those of the truth.
void add_top_ll(const TruthTopology& truth, const FrameComparison& frame, const LocalMap& map,
                const RangeConfig& range, TopLl& top_ll);

}  // namespace laneloom::evaluation
