#include "mapping/lanes/shoulders.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>

#include "mapping/lanes/lane_geometry.hpp"
#include "mapping/markings/markings.hpp"

namespace laneloom::lanes {
namespace {

constexpr double kMaxWidth = 0.95;  // share of the other lane's width; more is a difference by chance

bool share_a_side(const Lane& a, const Lane& b) {
  for (const Side side_a : kSides)
    for (const Side side_b : kSides)
      if (lane_side(a, side_a).of == lane_side(b, side_b).of) return true;
  return false;
}

/// Tells which lanes are shoulders.
class Shoulders {
 public:
  Shoulders(const std::vector<Lane>& lanes, const std::vector<boundaries::BoundaryPair>& pairs,
            const boundaries::Boundaries& boundaries)
      : lanes_(lanes), pairs_(pairs), boundaries_(boundaries) {}

  /// Whether the lane lies between an edge on that side and the solid line of a wider lane.
  bool is_outside_a_lane(const Lane& lane, Side edge_side) const {
    const LaneSide line = lane_side(lane, opposite(edge_side));
    if (!is_edge(lane_side(lane, edge_side)) || is_edge(line)) return false;
    if (markings::dashed_excess_m(boundary_of(line).marking, line.range) >= 0.0) return false;
    const Lane* beside = lane_across(line, lanes_);
    if (beside == nullptr || lane.width_m >= kMaxWidth * beside->width_m) return false;
    const Side shared = beside->left_borders.front().boundary == line.of.boundary ? Side::left : Side::right;
    return !road_ends_at(*beside, opposite(shared));
  }

  bool is_driven_along(const Lane& lane, const Eigen::Isometry3d& T_map_body) const {
    return std::ranges::any_of(lanes_, [&](const Lane& other) {
      return share_a_side(lane, other) && ego_sense(other, T_map_body) != 0.0;
    });
  }

 private:
  const boundaries::LaneBoundary& boundary_of(const LaneSide& side) const {
    return boundaries_.of(side.of.boundary);
  }
  bool is_edge(const LaneSide& side) const { return boundary_of(side).is_edge(); }

  bool road_ends_at(const Lane& lane, Side side) const {
    const std::size_t left = boundaries_.index_of(lane.left_borders.front().boundary);
    const std::size_t right = boundaries_.index_of(lane.right_borders.front().boundary);
    return std::ranges::any_of(pairs_, [&](const boundaries::BoundaryPair& pair) {
      return pair.left == left && pair.right == right &&
             (side == Side::left ? pair.left_kerb : pair.right_kerb);
    });
  }

  const std::vector<Lane>& lanes_;
  const std::vector<boundaries::BoundaryPair>& pairs_;
  const boundaries::Boundaries& boundaries_;
};

}  // namespace

std::vector<Lane> without_shoulders(const std::vector<Lane>& lanes,
                                    const std::vector<boundaries::BoundaryPair>& pairs,
                                    const boundaries::Boundaries& boundaries,
                                    const Eigen::Isometry3d& T_map_body, const LaneConfig& config) {
  if (!config.find_shoulders) return lanes;
  const Shoulders shoulders(lanes, pairs, boundaries);
  std::vector<Lane> kept;
  std::ranges::copy_if(lanes, std::back_inserter(kept), [&](const Lane& lane) {
    const bool is_shoulder =
        lane.width_m < config.max_shoulder_width_m &&
        (shoulders.is_outside_a_lane(lane, Side::left) || shoulders.is_outside_a_lane(lane, Side::right)) &&
        !shoulders.is_driven_along(lane, T_map_body);
    return !is_shoulder;
  });
  return kept;
}

}  // namespace laneloom::lanes
