#include "export/network_builder.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "mapping/geometry/left_of.hpp"
#include "mapping/markings/markings.hpp"

namespace laneloom::exports {
namespace {

constexpr double kNodeStep_m = 1.0;  // between nodes of a virtual line
constexpr double kMinStep_m = 0.3;   // nodes that are nearer, or go back, are left out
constexpr double kMinEnd_m = 0.5;    // a shorter rest of a boundary is left out

using Way = RoadNetwork::Way;

Way::Kind kind_of(const Marking& marking) {
  if (marking.status == ElementStatus::inferred) return Way::Kind::virtual_line;
  if (marking.type == MarkingType::roadedge) return Way::Kind::roadedge;
  return marking.type == MarkingType::stopline ? Way::Kind::stopline : Way::Kind::laneline;
}

MarkingStyle style_of(const Marking& marking, const Stretch& range) {
  const double excess_m = markings::dashed_excess_m(marking, range);
  if (excess_m == 0.0) return MarkingStyle::unknown;
  return excess_m > 0.0 ? MarkingStyle::dashed : MarkingStyle::solid;
}

double mean_stddev_m(const Marking& marking, const Stretch& range) {
  if (marking.lateral_stddev_m.empty() || marking.lateral_stddev_m.size() != marking.points.size())
    return -1.0;
  const std::vector<double> arcs_m = arc_lengths(marking.points);
  const double middle_m = 0.5 * (range.from_m + range.to_m);
  return (markings::deviation_at(arcs_m, marking.lateral_stddev_m, range.from_m) +
          markings::deviation_at(arcs_m, marking.lateral_stddev_m, middle_m) +
          markings::deviation_at(arcs_m, marking.lateral_stddev_m, range.to_m)) /
         3.0;
}

Polyline with_ends(const Point& from, const Polyline& path, const Point& to) {
  Polyline points{from};
  for (const Point& point : path)
    if ((point - points.back()).head<2>().norm() > kMinStep_m && (point - to).head<2>().norm() > kMinStep_m)
      points.push_back(point);
  points.push_back(to);
  return points;
}

}  // namespace

NetworkBuilder::NetworkBuilder(const LocalMap& map, const Gates& gates, NodeGroups& groups)
    : map_(map), gates_(gates), groups_(groups) {
  std::map<std::size_t, std::pair<Point, double>> sums;
  for (std::size_t cut = 0; cut < gates.cuts().size(); ++cut) {
    auto& [sum, count] = sums.try_emplace(groups_.group(cut), Point::Zero(), 0.0).first->second;
    sum += gates.position(cut);
    count += 1.0;
  }
  for (const auto& [group, sum] : sums) nodes_.emplace(group, add_node(sum.first / sum.second));
}

std::size_t NetworkBuilder::add_node(const Point& point) {
  network_.nodes.push_back(point);
  return network_.nodes.size() - 1;
}

std::size_t NetworkBuilder::node_of(std::size_t cut) { return nodes_.at(groups_.group(cut)); }

Way NetworkBuilder::way_on(std::size_t boundary, const Stretch& range) const {
  const Marking& marking = map_.boundaries[boundary];
  return {.kind = kind_of(marking),
          .style = style_of(marking, range),
          .nodes = {},
          .existence_probability = marking.existence_probability,
          .lateral_stddev_m = mean_stddev_m(marking, range)};
}

std::size_t NetworkBuilder::way_between(std::size_t from, std::size_t to) {
  const auto known = ways_.find({from, to});
  if (known != ways_.end()) return known->second;
  const std::size_t boundary = gates_.cuts()[from].boundary;
  const Stretch range{gates_.cuts()[from].arc_m, gates_.cuts()[to].arc_m};
  Way way = way_on(boundary, range);
  way.nodes.push_back(node_of(from));
  const std::map<double, std::size_t>& order = gates_.on_boundary(boundary);
  const auto next = order.upper_bound(range.from_m);
  if (next->second == to) {
    const Polyline points =
        with_ends(gates_.position(from), gates_.course(boundary).slice(range), gates_.position(to));
    for (std::size_t i = 1; i + 1 < points.size(); ++i) way.nodes.push_back(add_node(points[i]));
    way.nodes.push_back(node_of(to));
  } else {
    for (auto cut = next; way.nodes.back() != node_of(to); ++cut) {
      const std::vector<std::size_t>& part =
          network_.ways[way_between(std::prev(cut)->second, cut->second)].nodes;
      way.nodes.insert(way.nodes.end(), part.begin() + 1, part.end());
    }
  }
  network_.ways.push_back(std::move(way));
  return ways_.emplace(std::pair(from, to), network_.ways.size() - 1).first->second;
}

RoadNetwork::Side NetworkBuilder::stretch(std::size_t from, std::size_t to) {
  const bool reversed = gates_.cuts()[to].arc_m < gates_.cuts()[from].arc_m;
  return {reversed ? way_between(to, from) : way_between(from, to), reversed};
}

RoadNetwork::Side NetworkBuilder::virtual_side(std::size_t from, std::size_t to, const Polyline& middle,
                                               double from_m, double to_m) {
  const MeasuredPolyline path(middle);
  const int steps = std::max(1, static_cast<int>(std::ceil(path.length() / kNodeStep_m)));
  const Point begin = network_.nodes[node_of(from)], end = network_.nodes[node_of(to)];
  Polyline points;
  for (int i = 1; i < steps; ++i) {
    const double share = static_cast<double>(i) / steps, arc_m = share * path.length();
    const Eigen::Vector2d along =
        (path.at(arc_m + kNodeStep_m) - path.at(arc_m - kNodeStep_m)).head<2>().normalized();
    const double lateral_m = from_m + share * (to_m - from_m);
    const Point point = geometry::beside(path.at(arc_m), along, lateral_m);
    const Point& last = points.empty() ? begin : points.back();
    if ((point - last).head<2>().dot(along) > kMinStep_m && (end - point).head<2>().dot(along) > kMinStep_m)
      points.push_back(point);
  }
  Way way{.kind = Way::Kind::virtual_line, .nodes = {node_of(from)}};
  for (const Point& point : points) way.nodes.push_back(add_node(point));
  way.nodes.push_back(node_of(to));
  network_.ways.push_back(std::move(way));
  return {network_.ways.size() - 1, false};
}

std::pair<RoadNetwork::Side, RoadNetwork::Side> NetworkBuilder::sides_between(const Gates::Gate& from,
                                                                              const Gates::Gate& to,
                                                                              const Polyline& path) {
  const auto at = [&](std::size_t cut) { return network_.nodes[node_of(cut)]; };
  const Point begin = 0.5 * (at(from.left) + at(from.right)), end = 0.5 * (at(to.left) + at(to.right));
  const Polyline middle = with_ends(begin, path, end);
  const double from_m = 0.5 * (at(from.left) - at(from.right)).head<2>().norm();
  const double to_m = 0.5 * (at(to.left) - at(to.right)).head<2>().norm();
  const auto side = [&](std::size_t a, std::size_t b, double sign) {
    const auto &cut_a = gates_.cuts()[a], &cut_b = gates_.cuts()[b];
    const bool along =
        cut_a.boundary == cut_b.boundary && std::abs(cut_a.arc_m - cut_b.arc_m) < 1.5 * length(middle) + 1.0;
    return along ? stretch(a, b) : virtual_side(a, b, middle, sign * from_m, sign * to_m);
  };
  return {side(from.left, to.left, 1.0), side(from.right, to.right, -1.0)};
}

std::size_t NetworkBuilder::free_way(const Marking& marking) {
  Way way{.kind = kind_of(marking), .existence_probability = marking.existence_probability};
  for (const Point& point : marking.points) way.nodes.push_back(add_node(point));
  network_.ways.push_back(std::move(way));
  return network_.ways.size() - 1;
}

void NetworkBuilder::add(const RoadNetwork::Lanelet& lanelet) {
  network_.lanelets.push_back(lanelet);
  if (lanelet.lane != kNoElement) last_[lanelet.lane] = network_.lanelets.size() - 1;
}

void NetworkBuilder::add_end(std::size_t boundary, const Stretch& range, std::size_t cut) {
  if (range.length() < kMinEnd_m) return;
  Way way = way_on(boundary, range);
  const bool cut_first = gates_.cuts()[cut].arc_m == range.from_m;
  const Polyline points = gates_.course(boundary).slice(range);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool at_cut = cut_first ? i == 0 : i + 1 == points.size();
    way.nodes.push_back(at_cut ? node_of(cut) : add_node(points[i]));
  }
  network_.ways.push_back(std::move(way));
}

void NetworkBuilder::add_rest() {
  for (std::size_t i = 0; i < map_.boundaries.size(); ++i) {
    if (map_.boundaries[i].status == ElementStatus::inferred) continue;
    const std::map<double, std::size_t>& order = gates_.on_boundary(i);
    if (order.empty()) {
      Way way = way_on(i, {0.0, gates_.course(i).length()});
      for (const Point& point : gates_.course(i).points()) way.nodes.push_back(add_node(point));
      network_.ways.push_back(std::move(way));
      continue;
    }
    for (auto cut = order.begin(); std::next(cut) != order.end(); ++cut)
      way_between(cut->second, std::next(cut)->second);
    add_end(i, {0.0, order.begin()->first}, order.begin()->second);
    add_end(i, {order.rbegin()->first, gates_.course(i).length()}, order.rbegin()->second);
  }
}

}  // namespace laneloom::exports
