#include "mapping/lanes/lane_measures.hpp"

#include <algorithm>
#include <cmath>

#include "mapping/geometry/stretches.hpp"

namespace laneloom::lanes {
namespace {

constexpr std::size_t kLookAhead = 3;  // vertices; noise does not hold up the walker
constexpr double kPastEnd_m = 1.5;     // a line that ends this shortly before still counts

const Marking* find(const std::vector<Marking>& markings, ElementId id) {
  const auto found = std::ranges::find(markings, id, &Marking::id);
  return found == markings.end() ? nullptr : &*found;
}

}  // namespace

std::size_t NearestVertex::at(const Point& place) {
  const auto distance_m2 = [&](std::size_t i) { return (line_[i] - place).head<2>().squaredNorm(); };
  const std::size_t last = line_.size() - 1;
  std::size_t from = 0, to = last;
  if (nearest_)
    from = *nearest_ - std::min(*nearest_, kLookAhead), to = std::min(*nearest_ + kLookAhead, last);
  std::size_t best = nearest_.value_or(0);
  double best_m2 = distance_m2(best);
  for (std::size_t i = from; i <= to; ++i) {
    const double here_m2 = distance_m2(i);
    if (here_m2 >= best_m2) continue;
    best = i;
    best_m2 = here_m2;
    to = std::max(to, std::min(i + kLookAhead, last));
  }
  nearest_ = best;
  return best;
}

std::optional<double> NearestVertex::left_of(const Point& place, const Eigen::Vector2d& direction) {
  if (line_.empty()) return std::nullopt;
  const std::size_t nearest = at(place), last = line_.size() - 1;
  const auto along_m = [&](std::size_t i) { return direction.dot((line_[i] - place).head<2>()); };
  const auto left_m = [&](std::size_t i) { return cross(direction, (line_[i] - place).head<2>()); };
  for (std::size_t away = 0; away <= kLookAhead; ++away) {
    for (const std::size_t i : {nearest + away, nearest - std::min(nearest, away + 1)}) {
      if (i >= last) continue;
      const double a_m = along_m(i), b_m = along_m(i + 1);
      if (a_m * b_m > 0.0 || a_m == b_m) continue;
      return left_m(i) + a_m / (a_m - b_m) * (left_m(i + 1) - left_m(i));
    }
  }
  const bool at_end = (nearest == 0 || nearest == last) && std::abs(along_m(nearest)) < kPastEnd_m;
  return at_end ? std::optional(left_m(nearest)) : std::nullopt;
}

LaneMeasures::LaneMeasures(const LaneGraph& graph, const DirectedLane& lane)
    : lane_(lane),
      length_m_(laneloom::length(lane.lane->centerline)),
      changes_(graph, lane),
      boundaries_(graph.map().boundaries),
      left_(followed(Side::left)),
      right_(followed(Side::right)) {}

LaneMeasures::Followed LaneMeasures::followed(Side side) const {
  const Side own = as_seen(side, lane_.against);
  return {.side = own, .line = NearestVertex(own == Side::left ? lane_.lane->left : lane_.lane->right)};
}

void LaneMeasures::follow(double at_m, Followed& side) const {
  const Border* border = lane_.lane->border_at(side.side, at_m);
  if (border == side.border) return;
  side.border = border;
  side.vertices.reset();
  side.boundary = border == nullptr ? nullptr : find(boundaries_, border->boundary);
  if (side.boundary == nullptr || side.boundary->points.empty() ||
      side.boundary->lateral_stddev_m.size() != side.boundary->points.size())
    side.boundary = nullptr;
  else
    side.vertices.emplace(side.boundary->points);
}

std::optional<double> LaneMeasures::variance_m2(double at_m, const Point& place, Followed& side) const {
  follow(at_m, side);
  if (!side.vertices) return std::nullopt;
  const double stddev_m = side.boundary->lateral_stddev_m[side.vertices->at(place)];
  return stddev_m * stddev_m;
}

void LaneMeasures::fill(double arc_m, const Eigen::Vector2d& direction, WayStation& station) {
  const Lane& lane = *lane_.lane;
  station.lane = lane.id;
  const double at_m = lane_.against ? length_m_ - arc_m : arc_m;
  station.status = geometry::contains(lane.inferred_ranges, at_m) ? ElementStatus::inferred : lane.status;
  station.may_change_left = changes_.at(Side::left, arc_m).lane != nullptr;
  station.may_change_right = changes_.at(Side::right, arc_m).lane != nullptr;
  const auto left_m = left_.line.left_of(station.point, direction);
  const auto right_m = right_.line.left_of(station.point, direction);
  if (left_m) station.left_m = std::max(0.0, *left_m);
  if (right_m) station.right_m = std::max(0.0, -*right_m);
  if (left_m && right_m) station.width_m = *left_m - *right_m;
  const auto left_m2 = variance_m2(at_m, station.point, left_),
             right_m2 = variance_m2(at_m, station.point, right_);
  if (left_m2 && right_m2) station.lateral_stddev_m = 0.5 * std::sqrt(*left_m2 + *right_m2);
}

}  // namespace laneloom::lanes
