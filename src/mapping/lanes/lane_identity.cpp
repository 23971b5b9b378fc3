#include "mapping/lanes/lane_identity.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <utility>

#include "laneloom/polyline.hpp"
#include "mapping/lanes/lane_geometry.hpp"

namespace laneloom {
namespace {

/// Whether the first line runs as the second does, in the middle of the first.
bool same_way(const Polyline& line, const MeasuredPolyline& other) {
  const MeasuredPolyline measured(line);
  const double middle_m = 0.5 * measured.length();
  return measured.direction(middle_m).dot(other.direction(other.project(measured.at(middle_m)))) >= 0.0;
}

std::pair<ElementId, ElementId> boundary_pair(const Lane& lane) {
  return std::minmax(lane.left_boundary, lane.right_boundary);
}

}  // namespace

void identify_lanes(std::uint64_t frame, const LaneConfig& config, std::vector<Lane>& lanes,
                    std::vector<KnownLane>& known, ElementId& next_id) {
  struct Match {
    std::size_t covered;  ///< points of the lane
    std::size_t lane, known;
  };
  std::vector<std::optional<MeasuredPolyline>> measured(known.size());
  std::vector<bool> taken(known.size(), false);
  struct Direction {
    double log_odds = 0.0;
    int kept = 0;
  };
  std::map<ElementId, Direction> directions;
  // Between the same boundaries first, then wherever a lane has been.
  for (const bool same_boundaries : {true, false}) {
    std::vector<Match> matches;
    for (std::size_t k = 0; k < known.size(); ++k) {
      for (std::size_t i = 0; i < lanes.size() && !taken[k]; ++i) {
        const bool same = boundary_pair(lanes[i]) == std::pair(known[k].boundary_a, known[k].boundary_b);
        if (lanes[i].id != kNoElement || same != same_boundaries) continue;
        if (!measured[k]) measured[k].emplace(known[k].centerline);
        const std::size_t covered =
            points_beside(lanes[i].centerline, *measured[k], 0.5 * config.min_width_m);
        const std::size_t shorter = std::min(lanes[i].centerline.size(), known[k].centerline.size());
        if (same ? covered > 0 : 2 * covered >= shorter) matches.push_back({covered, i, k});
      }
    }
    std::ranges::stable_sort(matches, std::greater{}, &Match::covered);
    for (const auto& [covered, i, k] : matches) {
      if (taken[k] || lanes[i].id != kNoElement) continue;
      taken[k] = true;
      lanes[i].id = known[k].id;
      const int sense = same_way(lanes[i].centerline, *measured[k]) ? 1 : -1;
      directions[known[k].id] = {sense * known[k].direction_log_odds, sense * known[k].kept_direction};
    }
  }
  std::erase_if(known, [&](const KnownLane& lane) {
    const bool expired = lane.last_frame + static_cast<std::uint64_t>(config.id_memory_frames) < frame;
    return expired || std::ranges::any_of(lanes, [&](const Lane& l) { return l.id == lane.id; });
  });
  for (Lane& lane : lanes) {
    if (lane.id == kNoElement) lane.id = next_id++;
    const auto [a, b] = boundary_pair(lane);
    const Direction& direction = directions[lane.id];
    known.push_back({lane.id, a, b, lane.centerline, frame, direction.log_odds, direction.kept});
  }
  std::ranges::sort(lanes, {}, &Lane::id);
}

}  // namespace laneloom
