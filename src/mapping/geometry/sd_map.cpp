#include "laneloom/sd_map.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <set>
#include <stdexcept>

#include "laneloom/polyline.hpp"

namespace laneloom {
namespace {

constexpr double kCell_m = 50.0;
constexpr double kMaxDistance_m = 15.0;  // of a lane from the middle of its street
constexpr double kMinCosine = 0.8;       // of the angle between a lane and its street
constexpr double kMaxWay_m = 80.0;       // greatest detour between the two lanes
constexpr double kStraight = 0.7071;     // cosine of the greatest angle of a street that leads straight on

struct Foot {
  double distance_m, along_m;
};

Foot foot_on(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Eigen::Vector2d& point) {
  const Eigen::Vector2d along = to - from;
  const double share = std::clamp((point - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return {(point - from - share * along).norm(), share * along.norm()};
}

std::pair<int, int> cell_of(const Eigen::Vector2d& point) {
  const Eigen::Vector2d cell = (point / kCell_m).array().floor();
  return {static_cast<int>(cell.x()), static_cast<int>(cell.y())};
}

}  // namespace

SdMap::SdMap(std::vector<SdWay> ways, const std::vector<SdRestriction>& restrictions)
    : ways_(std::move(ways)) {
  for (const SdRestriction& restriction : restrictions)
    restrictions_[{restriction.from_way, restriction.via_node}].push_back(restriction);
  for (std::size_t i = 0; i < ways_.size(); ++i) {
    const SdWay& way = ways_[i];
    if (way.nodes.size() < 2 || way.nodes.size() != way.points.size())
      throw std::invalid_argument("way " + std::to_string(way.id) +
                                  " needs as many points as nodes, two at least");
    for (std::size_t k = 1; k < way.nodes.size(); ++k) {
      if ((way.points[k] - way.points[k - 1]).squaredNorm() <= 0.0) continue;
      segments_.push_back({i, way.nodes[k - 1], way.nodes[k], way.points[k - 1], way.points[k]});
      if (!way.oneway)
        segments_.push_back({i, way.nodes[k], way.nodes[k - 1], way.points[k], way.points[k - 1]});
    }
  }
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    leaving_[segments_[i].begin].push_back(i);
    enter_into_cells(i);
  }
}

// A segment is entered piece by piece: the box around a long slanting one would hold far more cells than it
// crosses.
void SdMap::enter_into_cells(std::size_t index) {
  const Eigen::Vector2d from = segments_[index].from, along = segments_[index].to - from;
  const int pieces = std::max(1, static_cast<int>(std::ceil(along.norm() / kCell_m)));
  for (int i = 0; i < pieces; ++i) {
    const Eigen::Vector2d begin = from + along * (static_cast<double>(i) / pieces);
    const Eigen::Vector2d end = from + along * (static_cast<double>(i + 1) / pieces);
    const auto [low_x, low_y] = cell_of(begin.cwiseMin(end).array() - kMaxDistance_m);
    const auto [high_x, high_y] = cell_of(begin.cwiseMax(end).array() + kMaxDistance_m);
    for (int x = low_x; x <= high_x; ++x) {
      for (int y = low_y; y <= high_y; ++y) {
        auto& cell = cells_[{x, y}];
        if (cell.empty() || cell.back() != index) cell.push_back(index);
      }
    }
  }
}

const SdMap::Segment* SdMap::nearest(const Eigen::Vector2d& point, const Eigen::Vector2d& direction) const {
  const auto cell = cells_.find(cell_of(point));
  if (cell == cells_.end()) return nullptr;
  const Segment* best = nullptr;
  double best_m = kMaxDistance_m;
  for (const std::size_t i : cell->second) {
    const Segment& segment = segments_[i];
    if ((segment.to - segment.from).normalized().dot(direction) < kMinCosine) continue;
    const double distance_m = foot_on(segment.from, segment.to, point).distance_m;
    if (distance_m < best_m) {
      best = &segment;
      best_m = distance_m;
    }
  }
  return best;
}

/// Calls `visit(way, is_along)` for the streets around a place, in each direction in which they may be
/// driven.
template <class Visit>
void SdMap::visit_around(const Eigen::Vector2d& place, const Eigen::Vector2d& direction,
                         Visit&& visit) const {
  const auto cell = cells_.find(cell_of(place));
  if (cell == cells_.end()) return;
  for (const std::size_t i : cell->second) {
    const Segment& segment = segments_[i];
    if (foot_on(segment.from, segment.to, place).distance_m > kMaxDistance_m) continue;
    const double cosine = (segment.to - segment.from).normalized().dot(direction);
    if (std::abs(cosine) >= kMinCosine) visit(ways_[segment.way], cosine > 0.0);
  }
}

int SdMap::one_way_at(const Eigen::Vector2d& place, const Eigen::Vector2d& direction) const {
  bool along = false, against = false;
  visit_around(place, direction, [&](const SdWay&, bool is_along) { (is_along ? along : against) = true; });
  return static_cast<int>(along) - static_cast<int>(against);
}

int SdMap::lanes_at(const Eigen::Vector2d& place, const Eigen::Vector2d& direction) const {
  std::optional<int> lanes;
  bool agree = true, along = false, against = false;
  visit_around(place, direction, [&](const SdWay& way, bool is_along) {
    agree = agree && lanes.value_or(way.lanes) == way.lanes;
    lanes = way.lanes;
    if (way.oneway) (is_along ? along : against) = true;
  });
  return agree && !(along && against) ? lanes.value_or(0) : 0;
}

std::optional<SdMap::Place> SdMap::beside(const Eigen::Vector2d& place,
                                          const Eigen::Vector2d& direction) const {
  const Segment* segment = nearest(place, direction);
  if (segment == nullptr) return std::nullopt;
  const Eigen::Vector2d along = (segment->to - segment->from).normalized();
  return Place{segment->from + foot_on(segment->from, segment->to, place).along_m * along, along};
}

Polyline SdMap::onward(const Eigen::Vector2d& place, const Eigen::Vector2d& direction,
                       double length_m) const {
  Polyline line;
  const auto begin = beside(place, direction);
  if (!begin) return line;
  line.emplace_back(begin->point.x(), begin->point.y(), 0.0);
  for (const Segment* segment = nearest(place, direction); segment != nullptr && length_m > 0.0;
       segment = straight_on(*segment)) {
    const Point step = Point(segment->to.x(), segment->to.y(), 0.0) - line.back();
    const double step_m = step.norm();
    if (step_m <= 0.0) continue;
    line.emplace_back(line.back() + std::min(1.0, length_m / step_m) * step);
    length_m -= step_m;
  }
  return line;
}

/// The street that leads on from the end of a segment: the only one, or the only one straight on. Null: none
/// does.
const SdMap::Segment* SdMap::straight_on(const Segment& segment) const {
  std::vector<const Segment*> all, straight;
  const auto following = leaving_.find(segment.end);
  if (following == leaving_.end()) return nullptr;
  const Eigen::Vector2d ahead = (segment.to - segment.from).normalized();
  for (const std::size_t i : following->second) {
    const Segment& next = segments_[i];
    if (!may_follow(segment, next)) continue;
    all.push_back(&next);
    if ((next.to - next.from).normalized().dot(ahead) > kStraight) straight.push_back(&next);
  }
  if (all.size() == 1) return all.front();
  return straight.size() == 1 ? straight.front() : nullptr;
}

bool SdMap::may_follow(const Segment& segment, const Segment& next) const {
  if (next.end == segment.begin) return false;  // about turn
  const std::int64_t from = ways_[segment.way].id, to = ways_[next.way].id;
  const auto found = restrictions_.find({from, segment.end});
  if (found == restrictions_.end()) return true;
  return std::ranges::all_of(found->second, [to](const SdRestriction& restriction) {
    return restriction.only == (restriction.to_way == to);
  });
}

SdMap::Verdict SdMap::verdict(const Polyline& from, const Polyline& to) const {
  const Eigen::Vector2d end = from.back().head<2>(), begin = to.front().head<2>();
  const Segment* left = nearest(end, end_direction(from, End::back));
  const Segment* entered = nearest(begin, -end_direction(to, End::front));
  if (left == nullptr || entered == nullptr) return Verdict::unknown;
  const double left_at_m = foot_on(left->from, left->to, end).along_m;
  const double entered_at_m = foot_on(entered->from, entered->to, begin).along_m;
  if (left == entered) return entered_at_m > left_at_m ? Verdict::connected : Verdict::forbidden;

  // Dijkstra's search over segments, by the length of the way to their beginning.
  const double max_m = (begin - end).norm() + kMaxWay_m;
  using Open = std::pair<double, const Segment*>;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  std::set<const Segment*> closed;
  open.emplace(-left_at_m, left);
  while (!open.empty()) {
    const auto [way_m, segment] = open.top();
    open.pop();
    if (segment == entered) return Verdict::connected;
    if (!closed.insert(segment).second) continue;
    const double next_m = way_m + (segment->to - segment->from).norm();
    const auto following = leaving_.find(segment->end);
    if (next_m > max_m || following == leaving_.end()) continue;
    for (const std::size_t i : following->second)
      if (may_follow(*segment, segments_[i])) open.emplace(next_m, &segments_[i]);
  }
  return Verdict::forbidden;
}

}  // namespace laneloom
