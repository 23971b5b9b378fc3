#include "mapping/shoulders.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "mapping/ego_track.hpp"
#include "mapping/lane_geometry.hpp"
#include "mapping/markings.hpp"

namespace laneloom {
namespace {

constexpr double kMaxWidth = 0.95;  // of the lane beside it; more is a difference by chance

bool share_a_side(const Lane& a, const Lane& b) {
  for (const bool left_a : {true, false})
    for (const bool left_b : {true, false})
      if (lane_side(a, left_a).of == lane_side(b, left_b).of) return true;
  return false;
}

}  // namespace

void remove_shoulders(const std::vector<BoundaryPair>& pairs, const std::vector<LaneBoundary>& boundaries,
                      const Eigen::Isometry3d& T_map_body, const LaneConfig& config,
                      std::vector<Lane>& lanes) {
  const auto marking = [&](ElementId id) -> const Marking& {
    return boundaries[index_of(boundaries, id)].marking;
  };
  const auto is_edge = [&](ElementId id) { return marking(id).type == MarkingType::roadedge; };
  const auto road_ends_at = [&](const Lane& lane, bool left) {
    const std::size_t a = index_of(boundaries, lane.left_boundary);
    const std::size_t b = index_of(boundaries, lane.right_boundary);
    return std::ranges::any_of(pairs, [&](const BoundaryPair& pair) {
      return pair.left == a && pair.right == b && (left ? pair.left_kerb : pair.right_kerb);
    });
  };
  const auto is_outside_a_lane = [&](const Lane& lane, bool edge_on_left) {
    const LaneSide line = lane_side(lane, !edge_on_left);
    if (!is_edge(lane_side(lane, edge_on_left).of.boundary) || is_edge(line.of.boundary)) return false;
    if (dashed_excess_m(marking(line.of.boundary), line.range) >= 0.0) return false;
    const Lane* beside = lane_across(line, lanes);
    if (beside == nullptr || lane.width_m >= kMaxWidth * beside->width_m) return false;
    return !road_ends_at(*beside, beside->left_boundary != line.of.boundary);
  };
  const auto driven =
      std::ranges::find_if(lanes, [&](const Lane& lane) { return ego_sense(lane, T_map_body) != 0.0; });
  const auto is_shoulder = [&](const Lane& lane) {
    return lane.width_m < config.max_shoulder_width_m &&
           (is_outside_a_lane(lane, true) || is_outside_a_lane(lane, false)) &&
           (driven == lanes.end() || !share_a_side(lane, *driven));
  };
  std::vector<Lane> others;
  std::ranges::remove_copy_if(lanes, std::back_inserter(others), is_shoulder);
  lanes = std::move(others);
}

}  // namespace laneloom
