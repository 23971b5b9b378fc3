#include "mapping/crossings.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "laneloom/polyline.hpp"

namespace laneloom {
namespace {

constexpr double kPathStep_m = 1.0;

struct Crossing {
  double misfit = 0.0;  ///< 0: exactly ahead; 1: just acceptable
  std::size_t from = 0, to = 0;
};

/// How badly `to` lies ahead of `from`; empty: it does not.
std::optional<double> misfit(const Lane& from, const Lane& to, const LinkageConfig& config) {
  const Eigen::Vector2d leaving = end_direction(from.centerline, true);
  const Eigen::Vector2d entering = -end_direction(to.centerline, false);
  const double turn = std::abs(cross(leaving, entering));
  const double max_turn =
      std::sqrt(1.0 - cos_degrees(config.max_angle_deg) * cos_degrees(config.max_angle_deg));
  const Eigen::Vector2d gap = (to.centerline.front() - from.centerline.back()).head<2>();
  const double along_m = gap.dot(leaving);
  if (leaving.dot(entering) <= 0.0 || turn > max_turn) return std::nullopt;
  if (along_m <= config.max_gap_m || along_m > config.max_crossing_gap_m) return std::nullopt;
  // From either end, so that a bend within the intersection is shared between them.
  const double lateral_m = 0.5 * std::abs(cross(leaving, gap) + cross(entering, gap));
  if (lateral_m > config.max_crossing_lateral_m) return std::nullopt;
  return 0.5 * (lateral_m / config.max_crossing_lateral_m + turn / max_turn);
}

/// A cubic that leaves and enters in the lanes' directions.
Polyline path_between(const Lane& from, const Lane& to) {
  const Point a = from.centerline.back(), b = to.centerline.front();
  const double length_m = (b - a).head<2>().norm();
  const Eigen::Vector2d leaving = length_m * end_direction(from.centerline, true);
  const Eigen::Vector2d entering = -length_m * end_direction(to.centerline, false);
  const int steps = std::max(1, static_cast<int>(std::ceil(length_m / kPathStep_m)));
  Polyline path;
  for (int i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    const double blend = t * t * (3.0 - 2.0 * t);  // Hermite's basis
    Point point = a + blend * (b - a);
    point.head<2>() += t * (1.0 - t) * ((1.0 - t) * leaving - t * entering);
    path.push_back(point);
  }
  return path;
}

}  // namespace

void link_across_intersections(const std::vector<Lane>& lanes, const LinkageConfig& config,
                               std::vector<Linkage>& linkages) {
  const auto goes_on = [&](ElementId id) { return std::ranges::count(linkages, id, &Linkage::from) > 0; };
  const auto is_reached = [&](ElementId id) { return std::ranges::count(linkages, id, &Linkage::to) > 0; };
  std::vector<Crossing> crossings;
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    if (goes_on(lanes[i].id)) continue;
    for (std::size_t j = 0; j < lanes.size(); ++j) {
      if (i == j || is_reached(lanes[j].id)) continue;
      if (const auto fit = misfit(lanes[i], lanes[j], config)) crossings.push_back({*fit, i, j});
    }
  }
  std::ranges::sort(crossings, {}, [](const Crossing& c) { return std::tuple(c.misfit, c.from, c.to); });
  std::vector<bool> left(lanes.size(), false), entered(lanes.size(), false);
  for (const Crossing& crossing : crossings) {
    if (left[crossing.from] || entered[crossing.to]) continue;
    left[crossing.from] = entered[crossing.to] = true;
    const Lane &from = lanes[crossing.from], &to = lanes[crossing.to];
    linkages.push_back({.from = from.id,
                        .to = to.id,
                        .kind = Linkage::Kind::intersection,
                        .turn = Linkage::Turn::straight,
                        .confidence = 0.9 - 0.5 * crossing.misfit,
                        .path = path_between(from, to)});
  }
  std::ranges::stable_sort(linkages, {}, [](const Linkage& l) { return std::tuple(l.from, l.to, l.kind); });
}

}  // namespace laneloom
