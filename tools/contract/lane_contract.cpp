#include <algorithm>
#include <cmath>
#include <map>

#include "contract/findings.hpp"
#include "laneloom/lane_graph.hpp"

namespace laneloom::contract {
namespace {

/// A lane's sides are fitted to noisy boundaries, so that sides and centerline may cross each other by this
/// much.
constexpr double kSideTolerance_m = 0.05;
constexpr double kJointTolerance_m = 0.01;
constexpr double kBorderTolerance_m = 0.05;

using BoundariesById = std::map<ElementId, const Marking*>;

/// Whether all points of `line` that have a foot within `reference` lie on one side of it. `side` is +1 for
/// the left, -1 for the right.
bool stays_on_side(const Polyline& line, const MeasuredPolyline& reference, double side, double margin_m) {
  return std::all_of(line.begin(), line.end(), [&](const Point& point) {
    const Projection foot = reference.project(point);
    return !foot.inside || side * foot.lateral_m > margin_m;
  });
}

Eigen::Vector2d chord(const Polyline& line) { return (line.back() - line.front()).head<2>(); }

void check_shape(const Lane& lane, Findings& findings) {
  const bool has_left = check_line(lane.left, label(lane) + " left side", findings);
  const bool has_right = check_line(lane.right, label(lane) + " right side", findings);
  const bool has_centerline = check_line(lane.centerline, label(lane) + " centerline", findings);
  if (!has_left || !has_right || !has_centerline) return;
  const MeasuredPolyline left(lane.left), right(lane.right);
  const bool same_direction =
      chord(lane.left).dot(chord(lane.right)) > 0.0 && chord(lane.centerline).dot(chord(lane.right)) > 0.0;
  findings.require(same_direction, ContractRule::left_is_left, label(lane) + " has sides that run apart");
  findings.require(stays_on_side(lane.left, right, 1.0, 0.0) && stays_on_side(lane.right, left, -1.0, 0.0),
                   ContractRule::left_is_left, label(lane) + " has a left side that is not on the left");
  findings.require(stays_on_side(lane.centerline, right, 1.0, -kSideTolerance_m) &&
                       stays_on_side(lane.centerline, left, -1.0, -kSideTolerance_m),
                   ContractRule::centered_line, label(lane) + " has a centerline outside of it");
  for (const Stretch& range : lane.inferred_ranges)
    check_range(range, length(lane.centerline), label(lane) + " inferred", findings);
}

void check_border(const Lane& lane, const Border& border, const BoundariesById& boundaries,
                  Findings& findings) {
  if (border.boundary == kNoElement) return;
  const auto found = boundaries.find(border.boundary);
  const std::string id = std::to_string(border.boundary);
  if (findings.require(found != boundaries.end(), ContractRule::known_ids,
                       label(lane) + " lies at unknown boundary " + id))
    check_range(border.on_boundary, length(found->second->points), label(lane) + " on boundary " + id,
                findings);
}

void check_borders(const Lane& lane, Side side, const BoundariesById& boundaries, Findings& findings) {
  double covered_m = 0.0;
  bool in_order = true;
  for (const Border& border : lane.borders(side)) {
    in_order = in_order && std::abs(border.range.from_m - covered_m) <= kBorderTolerance_m &&
               border.range.to_m > border.range.from_m;
    covered_m = border.range.to_m;
    check_border(lane, border, boundaries, findings);
  }
  const bool covered = std::abs(covered_m - length(lane.centerline)) <= kBorderTolerance_m;
  findings.require(
      in_order && covered, ContractRule::covering_borders,
      label(lane) + " is not covered by its " + (side == Side::left ? "left" : "right") + " borders");
}

/// Whether two lanes run the same way along the stretch `beside` of `a`. Elsewhere both may bend.
bool same_way(const Lane& a, const Stretch& beside, const Lane& b) {
  const MeasuredPolyline line_a(a.centerline), line_b(b.centerline);
  const double middle_m = 0.5 * (beside.from_m + beside.to_m);
  const Projection foot = line_b.project(line_a.at(middle_m));
  return line_a.direction(middle_m).dot(line_b.direction(foot.arc_m)) > 0.0;
}

/// Whether a boundary lies between a lane and the one beside it.
bool share_boundary(const std::vector<Border>& borders, const Stretch& beside,
                    const std::vector<Border>& facing) {
  return std::ranges::any_of(borders, [&](const Border& border) {
    return border.boundary != kNoElement && border.range.from_m < beside.to_m &&
           beside.from_m < border.range.to_m &&
           std::ranges::find(facing, border.boundary, &Border::boundary) != facing.end();
  });
}

void check_stretches(const Neighbour& neighbour, const Lane& lane, const std::string& what,
                     Findings& findings) {
  check_range(neighbour.range, length(lane.centerline), what, findings);
  for (const Stretch& crossable : neighbour.crossable) {
    const bool within =
        crossable.from_m >= neighbour.range.from_m - 1e-6 && crossable.to_m <= neighbour.range.to_m + 1e-6;
    findings.require(within, ContractRule::range_in_boundary, what + " may be crossed where it does not lie");
  }
}

void check_neighbour(const Lane& lane, const Neighbour& neighbour, Side side, const LaneGraph& lanes,
                     Findings& findings) {
  const std::string what = label(lane) + (side == Side::left ? " left" : " right") + " neighbour " +
                           std::to_string(neighbour.lane);
  const Lane* found = lanes.find(neighbour.lane);
  if (!findings.require(found != nullptr && neighbour.lane != lane.id, ContractRule::known_ids,
                        what + " is not another lane of the map"))
    return;
  const Lane& other = *found;
  if (!is_measurable(lane.centerline) || !is_measurable(other.centerline)) return;  // recorded already
  check_stretches(neighbour, lane, what, findings);
  const Side facing_side = same_way(lane, neighbour.range, other) ? opposite(side) : side;
  const auto& facing = neighbours(other, facing_side);
  findings.require(std::ranges::find(facing, lane.id, &Neighbour::lane) != facing.end(),
                   ContractRule::neighbours_across_boundary, what + " does not name it in return");
  findings.require(share_boundary(lane.borders(side), neighbour.range, other.borders(facing_side)),
                   ContractRule::neighbours_across_boundary, what + " is not across the boundary");
}

void check_trust(const Lane& lane, Findings& findings) {
  check_probability(lane.existence_probability, label(lane), findings);
  check_probability(lane.use_probability, label(lane) + " use", findings);
  check_probability(lane.direction_probability, label(lane) + " direction", findings);
  findings.require(std::isfinite(lane.width_m) && lane.width_m > 0.0, ContractRule::valid_values,
                   label(lane) + " has width " + std::to_string(lane.width_m));
  findings.require(lane.evidence != Evidence::none, ContractRule::stated_evidence,
                   label(lane) + " has no evidence");
  const bool told = lane.direction != Lane::Direction::unknown;
  findings.require(
      (lane.direction_evidence != Evidence::none) == told && (lane.direction_probability >= 0.0) == told,
      ContractRule::stated_evidence,
      label(lane) + (told ? " tells a direction without evidence or probability"
                          : " has evidence of a direction that it does not tell"));
}

/// Whether the middle of a lane runs as another one does beside it. Lanes that are not side by side do.
bool runs_as(const Lane& lane, const Lane& other) {
  const MeasuredPolyline line(lane.centerline), other_line(other.centerline);
  const double middle_m = 0.5 * line.length();
  const Projection foot = other_line.project(line.at(middle_m));
  return !foot.inside || line.direction(middle_m).dot(other_line.direction(foot.arc_m)) > 0.0;
}

}  // namespace

void check_joints(const LocalMap& map, Findings& findings) {
  const LaneGraph lanes(map);
  const auto meet = [](const Point& a, const Point& b) { return (a - b).norm() <= kJointTolerance_m; };
  for (const Linkage& linkage : map.linkages) {
    const Lane *from = lanes.find(linkage.from), *to = lanes.find(linkage.to);
    if (from == nullptr || to == nullptr || from->centerline.empty() || to->centerline.empty()) continue;
    const Point &end = from->centerline.back(), &begin = to->centerline.front();
    const bool joined = linkage.path.empty()
                            ? meet(end, begin)
                            : meet(end, linkage.path.front()) && meet(linkage.path.back(), begin);
    findings.require(joined, ContractRule::joined_lanes_meet,
                     "linkage " + std::to_string(linkage.from) + " -> " + std::to_string(linkage.to) +
                         " does not lead from the one to the other");
  }
}

void check_orientations(const LocalMap& map, const LocalMap& previous, Findings& findings) {
  const LaneGraph before(previous);
  for (const Lane& lane : map.lanes) {
    const Lane* same = before.find(lane.id);
    if (same == nullptr || !is_measurable(lane.centerline) || !is_measurable(same->centerline)) continue;
    findings.require(runs_as(lane, *same), ContractRule::kept_orientation, label(lane) + " was turned round");
  }
}

void check_lineage(const LocalMap& map, const LocalMap& previous, Findings& findings) {
  using Kind = LineageEvent::Kind;
  const LaneGraph now(map), before(previous);
  const auto require_event = [&](const Lane& lane, Kind alone, Kind related, const char* what) {
    const bool told = std::ranges::any_of(map.lineage, [&](const LineageEvent& event) {
      return event.element == LineageEvent::Element::lane && event.id == lane.id &&
             (event.kind == alone || event.kind == related);
    });
    findings.require(told, ContractRule::told_lineage, label(lane) + what);
  };
  for (const Lane& lane : map.lanes)
    if (before.find(lane.id) == nullptr)
      require_event(lane, Kind::born, Kind::split_from, " came without an event");
  for (const Lane& lane : previous.lanes)
    if (now.find(lane.id) == nullptr)
      require_event(lane, Kind::retired, Kind::merged_into, " went without an event");
}

void check_lanes(const LocalMap& map, Findings& findings) {
  const LaneGraph lanes(map);
  BoundariesById boundaries;
  for (const Marking& boundary : map.boundaries) boundaries.emplace(boundary.id, &boundary);
  for (const Lane& lane : map.lanes) {
    check_shape(lane, findings);
    for (const Side side : kSides) {
      check_borders(lane, side, boundaries, findings);
      for (const Neighbour& neighbour : neighbours(lane, side))
        check_neighbour(lane, neighbour, side, lanes, findings);
    }
    check_trust(lane, findings);
  }
}

}  // namespace laneloom::contract
