#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <set>
#include <span>
#include <vector>

#include "mapping/lanes/lane_terms.hpp"

/// Lanes that a road may have. Ours.
namespace laneloom::lanes {

/// A candidate in consecutive cross-sections.
struct Hypothesis {
  Room room = Room::between;
  std::size_t base = 0;            ///< the boundary that is cut; the right one, unless the right side is open
  bool reversed = false;           ///< the cross-sections run against it
  std::size_t other = 0;           ///< the boundary on the left; `base` where a side is open
  std::size_t first = 0;           ///< cross-section with which it begins
  std::vector<std::size_t> marks;  ///< per cross-section, the mark of `other`
  std::vector<double> log_odds;    ///< per cross-section, that the lane is there
  std::vector<double> shoulder_log_odds{};  ///< likewise, that a shoulder is; empty: none is looked for
  std::vector<double> cycle_log_odds{};     ///< likewise, that a cycle lane is
};

/// Poses of the vehicle, T_map_body.
using Poses = std::span<const Eigen::Isometry3d>;

/// The vehicle's poses on the road whose lanes are looked for, and the places that it came through.
struct Driven {
  Poses poses{};
  std::span<const Point> way{};  ///< map frame, some metres apart
};

/// The left and the right boundaries of lanes that were known before.
using KnownBorders = std::set<std::array<ElementId, 2>>;

/// The knowledge of a road before its lanes are looked for.
struct KnownRoad {
  KnownBorders borders{};
  const SdMap* sd_map = nullptr;  ///< null: there is none
};

/// The hypotheses about the lanes on the left of a boundary, and about an open lane on its right. `cuts` are
/// its cross-sections. Lanes with unseen borders are left out as the configuration says.
std::vector<Hypothesis> hypotheses(std::size_t boundary, const RoadCuts& cuts,
                                   const boundaries::SectionGraph& road, Poses driven,
                                   const LaneConfig& config);

/// The hypotheses about the lanes between a boundary and opposed ones, where each lies on the right of the
/// other: about those that no boundary has on its left. `cuts` are reversed.
std::vector<Hypothesis> hypotheses_against(std::size_t boundary, const RoadCuts& cuts,
                                           const boundaries::SectionGraph& road, Poses driven,
                                           const LaneConfig& config);

/// Consecutive cross-sections of a hypothesis.
struct Run {
  std::size_t begin = 0, end = 0;
  double log_odds = 0.0;  ///< their sum, less what it takes for a lane to begin and to end

  std::size_t size() const { return end - begin; }
};

/// The runs with the greatest sums. A run lies where a lane rather is than not, and bridges places where it
/// rather is not, if the lane goes on behind them.
std::vector<Run> best_runs(const std::vector<double>& log_odds);

}  // namespace laneloom::lanes
