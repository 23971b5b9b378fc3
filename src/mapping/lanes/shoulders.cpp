#include "mapping/lanes/shoulders.hpp"

#include <algorithm>
#include <cstddef>

#include "mapping/lanes/lane_geometry.hpp"
#include "mapping/markings/markings.hpp"

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
  const auto marking = [&](ElementId id) -> const Marking& { return boundary_of(boundaries, id).marking; };
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
  const auto is_driven_along = [&](const Lane& lane) {
    return std::ranges::any_of(lanes, [&](const Lane& other) {
      return share_a_side(lane, other) && ego_sense(other, T_map_body) != 0.0;
    });
  };
  std::vector<std::ptrdiff_t> shoulders;
  for (std::size_t i = 0; i < lanes.size(); ++i)
    if (lanes[i].width_m < config.max_shoulder_width_m &&
        (is_outside_a_lane(lanes[i], true) || is_outside_a_lane(lanes[i], false)) &&
        !is_driven_along(lanes[i]))
      shoulders.push_back(static_cast<std::ptrdiff_t>(i));
  for (auto i = shoulders.rbegin(); i != shoulders.rend(); ++i) lanes.erase(lanes.begin() + *i);
}

}  // namespace laneloom
