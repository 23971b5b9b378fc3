#pragma once

#include <cstddef>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "mapping/geometry/oriented_groups.hpp"
#include "mapping/lanes/lane_tracks.hpp"
#include "mapping/topology/road_graph.hpp"
#include "mapping/topology/traffic.hpp"

/// Which way traffic runs in the lanes of one frame, as a graph. Ours, beyond the paper.
namespace laneloom::topology {

/// Greatest log odds of a direction by what was observed of a lane over time.
inline constexpr double kMaxObserved = 6.0;

/// A mean, 0 of nothing.
struct Mean {
  double sum = 0.0;
  int count = 0;
  void add(double value) {
    sum += value;
    ++count;
  }
  double value() const { return count == 0 ? 0.0 : sum / count; }
};

/// Two groups side by side.
struct SideBySideGroups {
  std::size_t left, right;
  double opposed;                        ///< log odds that they run against each other
  bool may_part;                         ///< they may belong to two roads
  double to_left = 0.0, to_right = 0.0;  ///< messages of belief propagation
};

/// A group of lanes that continue one another, or lie along the same side of one boundary, is one variable.
/// Log odds are per group, that it runs along its first lane.
struct DirectionModel {
  geometry::OrientedGroups groups;
  double side = 0.0;               ///< 1: traffic keeps right; -1: it keeps left; 0: it is not known
  bool is_side_corrected = false;  ///< traffic told it, against the configuration
  std::vector<double> drive, borders, trails, streets;  ///< the terms of the evidence
  std::vector<double> evidence;                         ///< their sum
  std::vector<double> both_ways;  ///< log odds that traffic runs either way; 0: nothing tells it
  std::vector<SideBySideGroups> pairs;
};

/// Whether a lane runs against the first one of its group.
bool is_opposed(const geometry::OrientedGroups& groups, std::size_t lane);

/// The model of a road. `tracks` tell what was observed of its lanes before.
DirectionModel direction_model(const RoadGraph& road, DrivingSide driving_side, const RoadTraffic& traffic,
                               const lanes::LaneTracks& tracks);

/// Per group, the log odds of its direction in the most likely solution (max-product). Only maxima and sums
/// are computed, so that the result is the same to the last bit on every host. The messages stay in the
/// model.
std::vector<double> solve(DirectionModel& model);

/// Per group of a model that is solved, what tells its direction: terms of its own, and those of the groups
/// beside that count for it. Where traffic told the driving side, all that the side decides rests on traffic.
std::vector<Evidence> evidence_of(const DirectionModel& model, const std::vector<Lane>& lanes);

}  // namespace laneloom::topology
