#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/sd_map.hpp"
#include "laneloom/types.hpp"
#include "mapping/lanes/lane_tracks.hpp"
#include "mapping/topology/side_by_side.hpp"
#include "mapping/trails/trails.hpp"

namespace laneloom::topology {

/// A stretch that one trail has in one lane. Both are told by their indices.
struct DrivenStretch {
  std::size_t trail = 0, lane = 0;
  double along_m = 0.0;             ///< negative: against the points of the lane
  std::size_t first = 0, last = 0;  ///< points of the trail at which it begins and ends
};

/// The stretches of all trails within lanes: at most 1.2 m beside the middle, at most 30 degrees across it,
/// on its level. They are in the order of the trails, and of one trail as it was driven.
std::vector<DrivenStretch> driven_stretches(const std::vector<trails::Trail>& trails,
                                            const std::vector<Lane>& lanes);

/// Per lane, the share of it on which streets of the map are one-way streets: positive along the lane,
/// negative against it. Where the map has streets of either direction near the lane, it tells nothing.
/// Empty: there is no map.
std::vector<double> one_way_shares(const SdMap& sd_map, const std::vector<Lane>& lanes);

/// The lanes of a road that lie side by side, and what else than their borders tells of their directions.
struct RoadTraffic {
  std::vector<SideBySideLanes> beside;
  std::vector<DrivenStretch> driven;  ///< by others; in the order of the trails
  std::vector<double> one_way;        ///< as one_way_shares() tells
  bool is_side_corrected = false;     ///< traffic contradicts the configured driving side
  std::span<const Point> own_way{};   ///< places of the vehicle, map frame, the last one last
};

/// The cosine of 30 degrees. A vehicle at a wider angle crosses a lane.
inline constexpr double kCosInLane = 0.8660254;
/// Log odds from which on the own drive tells the direction of a lane.
inline constexpr double kOwnDriveKnown = 2.0;
/// Stretches of one trail shorter than this, in metres, tell no direction: the vehicle may have crossed.
inline constexpr double kMinDriven_m = 5.0;

/// The side on which traffic keeps, as vehicles that meet tell it.
class ObservedSide {
 public:
  /// Takes what trails tell that have not told it yet: a vehicle, or the own one, drives one way, and another
  /// one the other way in the next lane of the same road.
  void observe(const std::vector<Lane>& lanes, const RoadTraffic& traffic, const lanes::LaneTracks& tracks,
               std::vector<trails::Trail>& trails);
  /// Takes what oncoming vehicles tell that pass the own one while it moves in a lane. Both drive straight
  /// on: on a turn, vehicles pass on either side. No edge that was seen lies between: beyond one, they may
  /// drive on another road. `before` is the place of the own vehicle in the frame before, map frame.
  void observe_passing(const Point& before, const Eigen::Isometry3d& T_map_body,
                       const lanes::LaneLayout& layout, std::vector<trails::Trail>& trails);
  /// Whether traffic keeps to the other side than `driving_side`. Two vehicles more have told so than have
  /// told the contrary, and since then not as many have told the contrary.
  bool contradicts(DrivingSide driving_side) const;
  /// The side on which traffic keeps: the other one where it contradicts `driving_side`.
  DrivingSide corrected(DrivingSide driving_side) const;

  /// Forgets where the own vehicle began to drive straight on, as after a jump of its poses.
  void forget_course() { straight_heading_ = Eigen::Vector2d::Zero(); }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(told_, believed_, straight_from_, straight_heading_);
  }

 private:
  bool drives_straight(const Eigen::Isometry3d& T_map_body);
  void tell(int side);

  int told_ = 0;      ///< number of trails that told "right", less those that told "left"; limited
  int believed_ = 0;  ///< 1: right; -1: left; 0: neither
  Point straight_from_ = Point::Zero();  ///< where the own vehicle began to drive straight on, map frame
  Eigen::Vector2d straight_heading_ = Eigen::Vector2d::Zero();  ///< there; zero: nowhere yet
};

}  // namespace laneloom::topology
