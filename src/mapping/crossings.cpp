#include "mapping/crossings.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "laneloom/polyline.hpp"

namespace laneloom {
namespace {

constexpr double kPathStep_m = 1.0;

constexpr double kMinTurnSine = 0.77;  // of the angle between the lanes: a turn is one of 50 to 130 degrees

using Turn = Linkage::Turn;

struct Crossing {
  double misfit = 0.0;  ///< 0: as it should be; 1: just acceptable
  std::size_t from = 0, to = 0;
  Turn turn = Turn::straight;
};

Eigen::Vector2d leaving(const Lane& lane) { return end_direction(lane.centerline, true); }
Eigen::Vector2d entering(const Lane& lane) { return -end_direction(lane.centerline, false); }
Eigen::Vector2d gap_between(const Lane& from, const Lane& to) {
  return (to.centerline.front() - from.centerline.back()).head<2>();
}

/// How badly `to` lies ahead of `from`; empty: it does not.
std::optional<double> straight_misfit(const Lane& from, const Lane& to, const LinkageConfig& config) {
  const Eigen::Vector2d a = leaving(from), b = entering(to), gap = gap_between(from, to);
  const double angle = std::abs(cross(a, b));
  const double max_angle =
      std::sqrt(1.0 - cos_degrees(config.max_angle_deg) * cos_degrees(config.max_angle_deg));
  if (a.dot(b) <= 0.0 || angle > max_angle) return std::nullopt;
  const double along_m = gap.dot(a);
  if (along_m <= config.max_gap_m || along_m > config.max_crossing_gap_m) return std::nullopt;
  // From either end, so that a bend within the intersection is shared between them.
  const double lateral_m = 0.5 * std::abs(cross(a, gap) + cross(b, gap));
  if (lateral_m > config.max_crossing_lateral_m) return std::nullopt;
  return 0.5 * (lateral_m / config.max_crossing_lateral_m + angle / max_angle);
}

/// How badly one turns from `from` into `to`; empty: not at all.
std::optional<double> turn_misfit(const Lane& from, const Lane& to, const LinkageConfig& config) {
  const Eigen::Vector2d a = leaving(from), b = entering(to), gap = gap_between(from, to);
  const double sine = cross(a, b);
  if (std::abs(sine) < kMinTurnSine) return std::nullopt;
  // from + before * a = to - after * b
  const double before_m = cross(gap, b) / sine, after_m = cross(a, gap) / sine;
  const double shorter_m = std::min(before_m, after_m), longer_m = std::max(before_m, after_m);
  // A circle that touches both lanes' extensions has radius * tan(angle / 2) to either point of contact.
  const double tangent = (1.0 - a.dot(b)) / std::abs(sine);
  if (shorter_m < config.min_turn_radius_m * tangent || longer_m > config.max_turn_gap_m) return std::nullopt;
  return longer_m / config.max_turn_gap_m;
}

/// Where linkages begin and end already.
class Linked {
 public:
  explicit Linked(const std::vector<Linkage>& linkages) : linkages_(linkages) {}
  bool goes_on(const Lane& lane) const { return std::ranges::count(linkages_, lane.id, &Linkage::from) > 0; }
  bool is_reached(const Lane& lane) const { return std::ranges::count(linkages_, lane.id, &Linkage::to) > 0; }

 private:
  const std::vector<Linkage>& linkages_;
};

/// Whether no lane of the same direction lies beside it on the side that is turned to.
bool is_outermost(const Lane& lane, Turn turn, const std::vector<Lane>& lanes) {
  const bool left = turn == Turn::left;
  const ElementId id = left ? lane.left_neighbour : lane.right_neighbour;
  const auto beside = std::ranges::find(lanes, id, &Lane::id);
  // Of lanes that run against each other, each has the other on the same side.
  return beside == lanes.end() || (left ? beside->left_neighbour : beside->right_neighbour) == lane.id;
}

bool can_turn(const Lane& from, const Lane& to, Turn turn, const std::vector<Lane>& lanes) {
  const bool known = from.direction != Lane::Direction::unknown && to.direction != Lane::Direction::unknown;
  return known && is_outermost(from, turn, lanes) && is_outermost(to, turn, lanes);
}

std::vector<Crossing> possible_crossings(const std::vector<Lane>& lanes, const Linked& linked,
                                         const LinkageConfig& config) {
  std::vector<Crossing> crossings;
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    if (linked.goes_on(lanes[i])) continue;
    for (std::size_t j = 0; j < lanes.size(); ++j) {
      if (i == j || linked.is_reached(lanes[j])) continue;
      if (const auto straight = straight_misfit(lanes[i], lanes[j], config))
        crossings.push_back({*straight, i, j, Turn::straight});
      const Turn turn = cross(leaving(lanes[i]), entering(lanes[j])) > 0.0 ? Turn::left : Turn::right;
      if (!can_turn(lanes[i], lanes[j], turn, lanes)) continue;
      if (const auto misfit = turn_misfit(lanes[i], lanes[j], config))
        crossings.push_back({*misfit, i, j, turn});
    }
  }
  std::ranges::sort(crossings, {},
                    [](const Crossing& c) { return std::tuple(c.misfit, c.from, c.to, c.turn); });
  return crossings;
}

bool crosses_edge(const Polyline& path, const std::vector<LaneBoundary>& boundaries) {
  return std::ranges::any_of(boundaries, [&](const LaneBoundary& boundary) {
    return boundary.marking.type == MarkingType::roadedge && intersect(path, boundary.marking.points);
  });
}

double confidence(const Crossing& crossing) {
  return crossing.turn == Turn::straight ? 0.9 - 0.5 * crossing.misfit : 0.8 - 0.4 * crossing.misfit;
}

}  // namespace

Linkage::Turn turn_between(const Lane& from, const Lane& to) {
  const Eigen::Vector2d a = leaving(from), b = entering(to);
  if (a.dot(b) < -kMinTurnSine) return Turn::u_turn;
  if (std::abs(cross(a, b)) < kMinTurnSine) return Turn::straight;
  return cross(a, b) > 0.0 ? Turn::left : Turn::right;
}

Polyline path_between(const Lane& from, const Lane& to) {
  const Point a = from.centerline.back(), b = to.centerline.front();
  const double length_m = (b - a).head<2>().norm();
  const Eigen::Vector2d begin = length_m * leaving(from), end = length_m * entering(to);
  const int steps = std::max(1, static_cast<int>(std::ceil(length_m / kPathStep_m)));
  Polyline path;
  for (int i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    const double blend = t * t * (3.0 - 2.0 * t);  // Hermite's basis
    Point point = a + blend * (b - a);
    point.head<2>() += t * (1.0 - t) * ((1.0 - t) * begin - t * end);
    path.push_back(point);
  }
  return path;
}

void link_across_intersections(const std::vector<Lane>& lanes, const std::vector<LaneBoundary>& boundaries,
                               const LinkageConfig& config, std::vector<Linkage>& linkages) {
  std::set<std::pair<std::size_t, Turn>> left, entered;
  std::vector<Linkage> found;
  for (const auto& [misfit, i, j, turn] : possible_crossings(lanes, Linked(linkages), config)) {
    if (left.contains({i, turn}) || entered.contains({j, turn})) continue;
    Polyline path = path_between(lanes[i], lanes[j]);
    if (crosses_edge(path, boundaries)) continue;
    left.emplace(i, turn);
    entered.emplace(j, turn);
    found.push_back({.from = lanes[i].id,
                     .to = lanes[j].id,
                     .kind = Linkage::Kind::intersection,
                     .turn = turn,
                     .confidence = confidence({misfit, i, j, turn}),
                     .path = std::move(path)});
  }
  std::ranges::move(found, std::back_inserter(linkages));
  std::ranges::stable_sort(linkages, {}, [](const Linkage& l) { return std::tuple(l.from, l.to, l.kind); });
}

}  // namespace laneloom
