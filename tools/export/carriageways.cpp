#include "export/carriageways.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "export/strays.hpp"
#include "laneloom/polyline.hpp"

namespace laneloom::exports {
namespace {

using Side = RoadNetwork::Side;

constexpr double kShortest_m = 0.01;  // between two places of a reference line
constexpr int kLengthSteps = 8;

Polyline points_of(const RoadNetwork& network, const Side& side) {
  Polyline points;
  for (const std::size_t node : network.ways[side.way].nodes) points.push_back(network.nodes[node]);
  if (side.reversed) std::ranges::reverse(points);
  return points;
}

/// A side as a key: lanelets beside each other have it in common.
std::pair<std::size_t, bool> key(const Side& side) { return {side.way, side.reversed}; }

/// The distance to the right at which a line passes a place, or its nearest end.
double right_of(const Point& place, double heading_rad, const Polyline& line) {
  const Eigen::Vector2d ahead(std::cos(heading_rad), std::sin(heading_rad)), right(ahead.y(), -ahead.x());
  const auto coordinates = [&](const Point& point) {
    const Eigen::Vector2d offset = (point - place).head<2>();
    return Eigen::Vector2d(ahead.dot(offset), right.dot(offset));
  };
  std::optional<double> nearest;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Eigen::Vector2d from = coordinates(line[i - 1]), to = coordinates(line[i]);
    if ((from.x() < 0.0) == (to.x() < 0.0)) continue;
    const double distance_m = std::lerp(from.y(), to.y(), from.x() / (from.x() - to.x()));
    if (!nearest || std::abs(distance_m) < std::abs(*nearest)) nearest = distance_m;
  }
  if (nearest) return *nearest;
  const Eigen::Vector2d first = coordinates(line.front()), last = coordinates(line.back());
  return std::abs(first.x()) < std::abs(last.x()) ? first.y() : last.y();
}

/// Headings that bend evenly at each point.
std::vector<double> headings(const Polyline& line) {
  std::vector<double> result;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Point& before = line[i == 0 ? 0 : i - 1];
    const Point& after = line[std::min(i + 1, line.size() - 1)];
    // The shorter side tells more of the direction here.
    Eigen::Vector2d direction = (after - before).head<2>();
    if (i > 0 && i + 1 < line.size()) {
      const Eigen::Vector2d in = (line[i] - before).head<2>(), out = (after - line[i]).head<2>();
      direction = in / in.squaredNorm() + out / out.squaredNorm();
    }
    result.push_back(std::atan2(direction.y(), direction.x()));
  }
  return result;
}

Curve curve(const CrossSection& from, const CrossSection& to) {
  const Eigen::Rotation2Dd turn(-from.heading_rad);
  const Eigen::Vector2d end = turn * (to.place - from.place).head<2>();
  const double chord_m = end.norm(), heading = to.heading_rad - from.heading_rad;
  const Eigen::Vector2d begin_slope(chord_m, 0.0);
  const Eigen::Vector2d end_slope = chord_m * Eigen::Vector2d(std::cos(heading), std::sin(heading));
  Curve result{.b = begin_slope,
               .c = 3.0 * end - 2.0 * begin_slope - end_slope,
               .d = begin_slope + end_slope - 2.0 * end};
  for (int i = 0; i < kLengthSteps; ++i) {
    const double p = (i + 0.5) / kLengthSteps;
    result.length_m += (result.b + p * (2.0 * result.c + 3.0 * p * result.d)).norm() / kLengthSteps;
  }
  return result;
}

/// Whether it has a length.
bool lay_out(const RoadNetwork& network, Carriageway& way) {
  Polyline line;
  for (const Point& point : points_of(network, network.lanelets[way.lanelets.front()].left))
    if (line.empty() || (point - line.back()).head<2>().norm() > kShortest_m) line.push_back(point);
  if (line.size() < 2) return false;
  const std::vector<double> heading_rad = headings(line);
  std::vector<Polyline> borders;
  for (const std::size_t lanelet : way.lanelets)
    borders.push_back(points_of(network, network.lanelets[lanelet].right));
  for (std::size_t i = 0; i < line.size(); ++i) {
    CrossSection section{.place = line[i], .heading_rad = heading_rad[i]};
    double inner_m = 0.0;
    for (const Polyline& border : borders) {
      const double outer_m = std::max(inner_m, right_of(line[i], heading_rad[i], border));
      section.widths_m.push_back(outer_m - inner_m);
      inner_m = outer_m;
    }
    if (i > 0) {
      way.curves.push_back(curve(way.cross_sections.back(), section));
      section.along_m = way.cross_sections.back().along_m + way.curves.back().length_m;
    }
    way.cross_sections.push_back(std::move(section));
  }
  return true;
}

/// The lanelets of a network that lie beside each other in one carriageway.
class Neighbours {
 public:
  explicit Neighbours(const RoadNetwork& network)
      : lanelets_(network.lanelets), before_(lanelets_.size()), behind_(lanelets_.size()) {
    for (std::size_t i = 0; i < lanelets_.size(); ++i) {
      by_left_.emplace(key(lanelets_[i].left), i);
      by_right_.emplace(key(lanelets_[i].right), i);
    }
    for (const auto& [from, to] : followers(network)) {
      if (from.backwards || to.backwards) continue;
      behind_[from.lanelet].push_back(to.lanelet);
      before_[to.lanelet].push_back(from.lanelet);
    }
  }

  /// The lanelet on the right of another one. None: the two come from two roads, or lead to two.
  std::optional<std::size_t> right_of(std::size_t i) const {
    const auto right = beside(i);
    return right && go_on_together(behind_, i, *right) && go_on_together(before_, i, *right) ? right
                                                                                             : std::nullopt;
  }

 private:
  /// A lanelet to the right, if both have only each other there.
  std::optional<std::size_t> beside(std::size_t i) const {
    const auto found = by_left_.find(key(lanelets_[i].right));
    if (found == by_left_.end() || by_right_.at(found->first) != i) return std::nullopt;
    return found->second;
  }
  bool go_on_together(const std::vector<std::vector<std::size_t>>& next, std::size_t left,
                      std::size_t right) const {
    if (next[left].empty() || next[right].empty()) return true;
    return std::ranges::any_of(next[left], [&](std::size_t one) {
      return std::ranges::find(next[right], one) != next[right].end() ||
             std::ranges::find(next[right], beside(one).value_or(lanelets_.size())) != next[right].end();
    });
  }

  const std::vector<RoadNetwork::Lanelet>& lanelets_;
  std::map<std::pair<std::size_t, bool>, std::size_t> by_left_, by_right_;  ///< the first one with that side
  std::vector<std::vector<std::size_t>> before_, behind_;                   ///< by lanelet
};

}  // namespace

std::vector<Carriageway> carriageways(const RoadNetwork& network) {
  const Neighbours neighbours(network);
  std::vector<bool> is_right_neighbour(network.lanelets.size(), false);
  for (std::size_t i = 0; i < network.lanelets.size(); ++i)
    if (const auto right = neighbours.right_of(i)) is_right_neighbour[*right] = true;
  std::vector<Carriageway> ways;
  for (std::size_t i = 0; i < network.lanelets.size(); ++i) {
    if (is_right_neighbour[i]) continue;
    Carriageway way;
    for (std::optional<std::size_t> next = i; next; next = neighbours.right_of(*next))
      way.lanelets.push_back(*next);
    if (lay_out(network, way)) ways.push_back(std::move(way));
  }
  return ways;
}

}  // namespace laneloom::exports
