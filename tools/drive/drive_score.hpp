#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/distribution.hpp"
#include "drive/lane_tracker.hpp"

/// The score of a drive.
namespace laneloom::drive {

/// A departure: the vehicle's centre left its lane.
struct Departure {
  LaneTracker::Verdict how = LaneTracker::Verdict::off_lanes;
  double time_s = 0.0;
  Point place = Point::Zero();  ///< map frame
  ElementId lane = kNoElement;  ///< the last true lane that it was in
  bool in_intersection = false;
  bool guessed = false;  ///< whether the map had given no way there
};

/// A stretch for which neither the present map nor an earlier one gave a way.
struct Guess {
  enum class Cause : std::uint8_t {
    lane_ended,  ///< the lane that was followed had ended, and nothing led on
    no_linkage,  ///< likewise, before or in an intersection
    no_lane      ///< there was no lane near the vehicle
  };
  Cause cause = Cause::no_lane;
  double time_s = 0.0;
  Point place = Point::Zero();  ///< where it began
  double duration_s = 0.0;
  double distance_m = 0.0;
};

const char* name(LaneTracker::Verdict verdict);
const char* name(Guess::Cause cause);

/// The score of one drive, or of several together.
struct DriveScore {
  double time_s = 0.0;  ///< simulated
  double standing_s = 0.0;
  double driven_m = 0.0;
  double remembered_m = 0.0;           ///< part of driven_m on a way that an earlier map gave
  double inferred_m = 0.0;             ///< part of driven_m in inferred lanes
  Distribution lateral_m;              ///< of the centre from the true centerline, absolute
  Distribution lateral_mps2;           ///< acceleration, absolute
  Distribution jerk_mps3;              ///< lateral, absolute
  Distribution curvature_rate;         ///< absolute, 1/(m s)
  std::uint64_t border_crossings = 0;  ///< times that the body began to cross a border
  std::uint64_t road_ends = 0;         ///< number; after each, the vehicle begins anew
  std::uint64_t missed_turns = 0;
  std::vector<Departure> departures;  ///< after each, the vehicle is put back
  std::vector<Guess> guesses;

  double guessed_m() const;
  std::uint64_t restarts() const { return road_ends + departures.size(); }
  DriveScore& operator+=(const DriveScore& other);
};

}  // namespace laneloom::drive
