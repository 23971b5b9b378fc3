#include "mapping/lanes/lane_track.hpp"

#include <algorithm>
#include <utility>

namespace laneloom::lanes {

void LaneStation::swap_sides() {
  std::swap(border[0], border[1]);
  std::swap(boundary[0], boundary[1]);
}

Polyline centerline(const std::vector<LaneStation>& stations) {
  Polyline line;
  line.reserve(stations.size());
  for (const LaneStation& station : stations) line.push_back(station.center());
  return line;
}

void reverse(std::vector<LaneStation>& stations) {
  std::ranges::reverse(stations);
  for (LaneStation& station : stations) station.swap_sides();
  // Seen the other way, what lies behind a station lies behind the next one.
  for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
    stations[i].parted = stations[i + 1].parted;
    stations[i].stepped = stations[i + 1].stepped;
  }
  if (stations.empty()) return;
  stations.back().parted = 0.0;
  stations.back().stepped = false;
}

void reverse(LaneTrack& track) {
  reverse(track.stations);
  std::swap(track.parted[0], track.parted[1]);
  track.direction_log_odds = -track.direction_log_odds;
  track.belief = -track.belief;
  track.told_direction = -track.told_direction;
  track.published = -track.published;
}

}  // namespace laneloom::lanes
