#include "mapping/topology/intersections.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "laneloom/polyline.hpp"
#include "mapping/lanes/lane_geometry.hpp"
#include "mapping/markings/markings.hpp"

namespace laneloom::topology {
namespace {

using Turn = Linkage::Turn;

constexpr double kMisfit = 1.0;

struct Crossing {
  double misfit = 0.0;  ///< 0: a perfect fit; kMisfit: just acceptable without an SD map
  std::size_t from = 0, to = 0;
  Turn turn = Turn::straight;
  bool confirmed = false;  ///< by the SD map
};

/// Greatest gap between two lanes that may be linked.
double max_gap_m(const LinkageConfig& config) {
  return std::max(config.max_crossing_gap_m, 2.0 * config.max_turn_gap_m);
}

/// The misfit of `to` as the lane straight ahead of `from`. Empty: it is not ahead.
std::optional<double> straight_misfit(const Lane& from, const Lane& to, const LinkageConfig& config) {
  if (!config.straight_across) return std::nullopt;
  const Eigen::Vector2d a = lanes::leaving(from), b = lanes::entering(to), gap = lanes::gap_between(from, to);
  const double angle = std::abs(cross(a, b));
  const double max_angle =
      std::sqrt(1.0 - cos_degrees(config.max_angle_deg) * cos_degrees(config.max_angle_deg));
  if (a.dot(b) <= 0.0 || angle > max_angle) return std::nullopt;
  const double along_m = gap.dot(a);
  if (along_m <= config.max_gap_m || along_m > config.max_crossing_gap_m) return std::nullopt;
  // Measured from either end, so that a bend within the intersection is shared between them.
  const double lateral_m = 0.5 * std::abs(cross(a, gap) + cross(b, gap));
  if (lateral_m > config.max_crossing_lateral_m) return std::nullopt;
  return 0.5 * (lateral_m / config.max_crossing_lateral_m + angle / max_angle);
}

/// The misfit of a left or right turn from `from` into `to`. Empty: there is none.
std::optional<double> turn_misfit(const Lane& from, const Lane& to, const LinkageConfig& config) {
  const auto corner = lanes::corner_between(from, to);
  if (!corner) return std::nullopt;
  const double shorter_m = std::min(corner->before_m, corner->after_m);
  const double longer_m = std::max(corner->before_m, corner->after_m);
  // A circle touches the extensions of both lanes at a distance of radius * tan(angle / 2) from their corner.
  const Eigen::Vector2d a = lanes::leaving(from), b = lanes::entering(to);
  const double tangent = (1.0 - a.dot(b)) / std::abs(cross(a, b));
  if (shorter_m < config.min_turn_radius_m * tangent || longer_m > config.max_turn_gap_m) return std::nullopt;
  return longer_m / config.max_turn_gap_m;
}

/// The turns by which lanes are left and entered already.
class Taken {
 public:
  /// The linkages of `road` are those that follow from markings.
  explicit Taken(const RoadGraph& road) {
    const auto beside_unseen_edge = [&](ElementId id) {
      const Lane& lane = road.lane(id);
      return std::ranges::any_of(road.boundaries, [&](const boundaries::LaneBoundary& boundary) {
        return boundary.is_unseen_edge() && std::ranges::any_of(kSides, [&](Side side) {
                 return std::ranges::count(lane.borders(side), boundary.marking.id, &Border::boundary) > 0;
               });
      });
    };
    for (const Linkage& linkage : road.linkages) {
      take(linkage.from, linkage.to, linkage.turn);
      if (linkage.turn != Turn::straight) continue;
      if (beside_unseen_edge(linkage.from) || beside_unseen_edge(linkage.to)) continue;
      // Where markings lead straight on, there is no intersection.
      for (const Turn side : {Turn::left, Turn::right, Turn::u_turn}) take(linkage.from, linkage.to, side);
    }
  }
  bool contains(ElementId from, ElementId to, Turn turn) const {
    return left_.contains({from, turn}) || entered_.contains({to, turn});
  }
  void take(ElementId from, ElementId to, Turn turn) {
    left_.emplace(from, turn);
    entered_.emplace(to, turn);
  }

 private:
  std::set<std::pair<ElementId, Turn>> left_, entered_;
};

/// Length of dashed minus solid stretches of the lines along a lane's side.
double dashed_excess_m(const Lane& lane, Side side, const RoadGraph& road) {
  double excess_m = 0.0;
  for (const Border& border : lane.borders(side))
    if (border.boundary != kNoElement)
      excess_m += markings::dashed_excess_m(road.boundaries.of(border.boundary).marking, border.on_boundary);
  return excess_m;
}

/// Whether the lane is the outermost of its direction on the side that is turned to. A lane beside it counts
/// if it is known to run alike, or if its direction is unknown and dashes lie between the two.
bool is_outermost(const Lane& lane, Turn turn, const RoadGraph& road) {
  const Side side = turn == Turn::left ? Side::left : Side::right;
  const Lane* beside = road.find(lanes::main_neighbour(lane, side));
  if (beside == nullptr) return true;
  if (beside->direction == Lane::Direction::unknown) return dashed_excess_m(lane, side, road) <= 0.0;
  // Two lanes that run against each other have one another on the same side.
  return lanes::main_neighbour(*beside, side) == lane.id;
}

bool can_turn(const Lane& from, const Lane& to, Turn turn, const RoadGraph& road) {
  const bool known = from.direction != Lane::Direction::unknown && to.direction != Lane::Direction::unknown;
  return known && is_outermost(from, turn, road) && is_outermost(to, turn, road);
}

/// The crossing from `from` into `to`, by their geometry. A misfit above kMisfit needs the confirmation of an
/// SD map. Empty: there is none.
std::optional<Crossing> crossing(const Lane& from, const Lane& to, const RoadGraph& road,
                                 const LinkageConfig& config) {
  if (const auto straight = straight_misfit(from, to, config))
    return Crossing{.misfit = *straight, .turn = Turn::straight};
  if (!config.turns) return std::nullopt;
  const Turn side = cross(lanes::leaving(from), lanes::entering(to)) > 0.0 ? Turn::left : Turn::right;
  if (!can_turn(from, to, side, road)) return std::nullopt;
  if (const auto turn = turn_misfit(from, to, config)) return Crossing{.misfit = *turn, .turn = side};
  const double gap_m = lanes::gap_between(from, to).norm();
  const bool ahead = lanes::gap_between(from, to).dot(lanes::leaving(from)) > 0.0;
  if (!ahead || gap_m > config.max_turn_gap_m) return std::nullopt;
  return Crossing{.misfit = kMisfit + gap_m, .turn = turn_between(from, to)};
}

std::vector<Crossing> possible_crossings(const RoadGraph& road, const SdMap& sd_map,
                                         const LinkageConfig& config) {
  const std::vector<Lane>& lanes = road.lanes;
  std::vector<Crossing> crossings;
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    for (std::size_t j = 0; j < lanes.size(); ++j) {
      if (i == j || lanes::gap_between(lanes[i], lanes[j]).norm() > max_gap_m(config) ||
          !lanes::may_climb(lanes[i], lanes[j]))
        continue;
      auto found = crossing(lanes[i], lanes[j], road, config);
      if (!found) continue;
      const auto verdict = sd_map.verdict(lanes[i].centerline, lanes[j].centerline);
      found->confirmed = verdict == SdMap::Verdict::connected;
      if (verdict == SdMap::Verdict::forbidden || (found->misfit > kMisfit && !found->confirmed)) continue;
      found->from = i;
      found->to = j;
      crossings.push_back(*found);
    }
  }
  std::ranges::sort(crossings, {},
                    [](const Crossing& c) { return std::tuple(c.misfit, c.from, c.to, c.turn); });
  return crossings;
}

/// Whether a lane lies between two solid lines with lanes beyond, as lanes for turning do in the middle of a
/// road. The lane ahead of such a lane may be the turning lane of the other direction.
bool is_enclosed(const Lane& lane, const RoadGraph& road) {
  if (lane.left_neighbours.empty() || lane.right_neighbours.empty()) return false;
  return std::ranges::all_of(kSides, [&](Side side) { return dashed_excess_m(lane, side, road) < 0.0; });
}

/// Gives the direction of one lane to the other, if it is unknown: lanes that are linked straight on run the
/// same way. `confirmed`: the SD map links them.
void agree_on_direction(Lane& from, Lane& to, bool confirmed, const RoadGraph& road) {
  using Direction = Lane::Direction;
  if (from.direction == Direction::unknown && to.direction == Direction::unknown) return;
  const Lane& known = from.direction == Direction::unknown ? to : from;
  Lane& lane = from.direction == Direction::unknown ? from : to;
  if (lane.direction != Direction::unknown || is_enclosed(lane, road)) return;
  lane.direction = Direction::along_centerline;
  lane.direction_probability = known.direction_probability;
  lane.direction_evidence = known.direction_evidence | (confirmed ? Evidence::sd_map : Evidence::none);
}

double probability(const Crossing& crossing) {
  if (crossing.confirmed) return 0.95;
  return crossing.turn == Turn::straight ? 0.9 - 0.5 * crossing.misfit : 0.8 - 0.4 * crossing.misfit;
}

Lane reversed(Lane lane) {
  std::ranges::reverse(lane.centerline);
  return lane;
}

/// The lane and all lanes that are linked with it, directly or through others.
std::vector<ElementId> linked_with(ElementId lane, const std::vector<Linkage>& linkages) {
  std::vector<ElementId> ids{lane};
  for (std::size_t i = 0; i < ids.size(); ++i) {
    for (const Linkage& linkage : linkages) {
      const ElementId other = linkage.from == ids[i] ? linkage.to : linkage.from;
      const bool linked = linkage.from == ids[i] || linkage.to == ids[i];
      if (linked && std::ranges::count(ids, other) == 0) ids.push_back(other);
    }
  }
  return ids;
}

/// Turns lanes of unknown direction beyond an intersection that run towards a lane which would lead into
/// them. A lane is turned together with those that it is linked with.
void turn_unknown_ahead(const LinkageConfig& config, RoadGraph& road) {
  const auto is_unknown = [](const Lane& lane) { return lane.direction == Lane::Direction::unknown; };
  const auto leads_into = [&](const Lane& to) {
    return std::ranges::any_of(road.lanes, [&](const Lane& from) {
      return !is_unknown(from) && lanes::gap_between(from, to).norm() <= max_gap_m(config) &&
             straight_misfit(from, to, config).has_value();
    });
  };
  for (const Lane& lane : road.lanes) {
    if (!is_unknown(lane) || leads_into(lane) || !leads_into(reversed(lane))) continue;
    const std::vector<ElementId> chain = linked_with(lane.id, road.linkages);
    const bool all_unknown =
        std::ranges::all_of(chain, [&](ElementId id) { return is_unknown(road.lane(id)); });
    if (all_unknown) road.turn(chain);
  }
}

}  // namespace

void link_across_intersections(const SdMap& sd_map, const LinkageConfig& config, RoadGraph& road) {
  turn_unknown_ahead(config, road);
  Taken taken(road);
  const auto link = [&](const Crossing& crossing) {
    Lane &from = road.lanes[crossing.from], &to = road.lanes[crossing.to];
    if (taken.contains(from.id, to.id, crossing.turn)) return;
    Polyline path = lanes::path_between(from, to);
    if (boundaries::crosses_edge(path, road.boundaries)) return;
    taken.take(from.id, to.id, crossing.turn);
    if (crossing.turn == Turn::straight) agree_on_direction(from, to, crossing.confirmed, road);
    road.linkages.push_back(
        {.from = from.id,
         .to = to.id,
         .kind = crossing.confirmed ? Linkage::Kind::sd_map : Linkage::Kind::intersection,
         .turn = crossing.turn,
         .probability = probability(crossing),
         .evidence = evidence_between(from, to) | (crossing.confirmed ? Evidence::sd_map : Evidence::none),
         .path = std::move(path)});
  };
  // Straight on comes first: it tells directions, on which turns depend.
  for (const Crossing& crossing : possible_crossings(road, sd_map, config))
    if (crossing.turn == Turn::straight) link(crossing);
  for (const Crossing& crossing : possible_crossings(road, sd_map, config))
    if (crossing.turn != Turn::straight) link(crossing);
  road.sort_linkages();
}

}  // namespace laneloom::topology
