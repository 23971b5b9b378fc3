#include "drive/drive_score.hpp"

namespace laneloom::drive {

const char* name(LaneTracker::Verdict verdict) {
  switch (verdict) {
    case LaneTracker::Verdict::in_lane:
      return "in_lane";
    case LaneTracker::Verdict::road_ended:
      return "road_ended";
    case LaneTracker::Verdict::changed_lane:
      return "changed_lane";
    case LaneTracker::Verdict::oncoming:
      return "oncoming";
    case LaneTracker::Verdict::off_lanes:
      return "off_lanes";
  }
  return "unknown";
}

const char* name(Guess::Cause cause) {
  switch (cause) {
    case Guess::Cause::lane_ended:
      return "lane_ended";
    case Guess::Cause::no_linkage:
      return "no_linkage";
    case Guess::Cause::no_lane:
      return "no_lane";
  }
  return "unknown";
}

double DriveScore::guessed_m() const {
  double sum_m = 0.0;
  for (const Guess& guess : guesses) sum_m += guess.distance_m;
  return sum_m;
}

DriveScore& DriveScore::operator+=(const DriveScore& other) {
  time_s += other.time_s;
  standing_s += other.standing_s;
  driven_m += other.driven_m;
  remembered_m += other.remembered_m;
  inferred_m += other.inferred_m;
  lateral_m.add(other.lateral_m);
  lateral_mps2.add(other.lateral_mps2);
  jerk_mps3.add(other.jerk_mps3);
  curvature_rate.add(other.curvature_rate);
  border_crossings += other.border_crossings;
  road_ends += other.road_ends;
  missed_turns += other.missed_turns;
  departures.insert(departures.end(), other.departures.begin(), other.departures.end());
  guesses.insert(guesses.end(), other.guesses.begin(), other.guesses.end());
  return *this;
}

}  // namespace laneloom::drive
