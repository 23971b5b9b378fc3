#pragma once

#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "evaluation/evaluation.hpp"
#include "simulation/road.hpp"

/// The quality of linkages, directions and stoplines, by the project's definitions.
///
/// A truth lane is a chain of lanes that only continue one another (lane_chains.hpp). Its successors are
/// those that follow it, at once or across others (an intersection, or lanes that no markings bound).
/// - A published lane lies on the truth lane that most of its samples are less than 0.5 m from, if these are
///   at least 75 % of its samples in range; of equals, the nearer one. Where it states its direction, it must
///   run with the traffic; otherwise both senses will do.
/// - A linkage counts if both its lanes are in range. It is right if the last 5 m of the one and the first
///   5 m of the other lie on truth lanes A and B, B a successor of A (of lanes that run against the traffic:
///   A of B), or on the same one, in order.
/// - Recall: of the pairs A, B that both have a published lane on them, the share with a right linkage.
/// - Directions: of the published lanes in range that lie on a truth lane in either sense, those that state
///   theirs, and the share of these that run with the traffic; recall is the share of all.
/// - Stoplines: a truth stopline ends the truth lanes whose centerline, prolonged by 3 m, crosses it. Of the
///   published stoplines that are true positives: the share of their lanes in range that lie on such a lane,
///   and the share of such lanes, with a published lane on them, that are named.
namespace laneloom::evaluation {

inline constexpr std::size_t kLinkageKindCount = 6;

/// The successors of the truth lanes, and the lanes that each stopline ends.
struct TruthTopology {
  using LaneIndex = std::size_t;  ///< index of a chain, and of its line among the kind_lines()
  std::set<std::pair<LaneIndex, LaneIndex>> successors;
  std::map<std::size_t, std::set<LaneIndex>> lanes_of_stopline;  ///< by index among the kind_lines()
};

TruthTopology truth_topology(const simulation::Road& truth);

/// Counts of published statements and of true ones.
struct PairScore {
  std::size_t published = 0;
  std::size_t right = 0;  ///< number of the published that are right
  std::size_t truths = 0;
  std::size_t found = 0;  ///< number of the truths that were found

  double precision() const;  ///< 0..1
  double recall() const;     ///< 0..1
  double f1() const;         ///< 0..1
};

/// The scores of linkages, directions and lanes of stoplines, summed over frames.
struct TopologyScore {
  PairScore linkages;
  std::array<PairScore, kLinkageKindCount> by_kind;  ///< precision only: the truth knows no kinds
  PairScore directions;
  PairScore stopline_lanes;
};

/// Whether the traffic of a lane may run along its points, or `reversed`, from the last to the first.
bool may_run(Lane::Direction direction, bool reversed);

/// Adds the frame of `map`, whose kind_lines() were compared with those of the truth.
void add_topology(const TruthTopology& truth, const FrameComparison& frame, const LocalMap& map,
                  const RangeConfig& range, TopologyScore& score);

}  // namespace laneloom::evaluation
