#include "simulation/route.hpp"

#include <algorithm>
#include <deque>
#include <limits>
#include <map>
#include <set>

#include "laneloom/polyline.hpp"
#include "simulation/random.hpp"

namespace laneloom::simulation {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
constexpr int kMaxPasses = 2;
constexpr int kTriesPerLane = 20;
constexpr double kUnmarkedShare = 0.2;  // weight of a metre of a lane without lanelines

std::map<ElementId, std::size_t> index_by_id(const Road& road) {
  std::map<ElementId, std::size_t> index;
  for (std::size_t i = 0; i < road.lanes.size(); ++i) index[road.lanes[i].id] = i;
  return index;
}

// A random way, which goes on among the successors passed least often.
std::vector<std::size_t> wander(const std::vector<std::vector<std::size_t>>& successors, std::size_t from,
                                Random& random) {
  std::vector<int> passes(successors.size(), 0);
  std::vector<std::size_t> way;
  for (std::size_t lane = from; lane != kNone;) {
    way.push_back(lane);
    ++passes[lane];
    std::vector<std::size_t> best;
    int fewest = kMaxPasses;
    for (const std::size_t next : successors[lane]) {
      if (passes[next] < fewest) best.clear();
      fewest = std::min(fewest, passes[next]);
      if (passes[next] == fewest && fewest < kMaxPasses) best.push_back(next);
    }
    lane = best.empty() ? kNone : best[random.below(best.size())];
  }
  return way;
}

}  // namespace

std::size_t nearest_lane(const Road& road, const Point& point) {
  std::size_t best = 0;
  double best_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < road.lanes.size(); ++i) {
    const double distance_m = (MeasuredPolyline(road.lanes[i].centerline).project(point).foot - point).norm();
    if (distance_m < best_m - 1e-9) {
      best = i;
      best_m = distance_m;
    }
  }
  return best;
}

std::vector<std::size_t> shortest_way(const Road& road, std::size_t from, std::size_t to) {
  const std::map<ElementId, std::size_t> index = index_by_id(road);
  std::vector<std::size_t> previous(road.lanes.size(), kNone);
  std::deque<std::size_t> open{from};
  while (!open.empty() && previous[to] == kNone) {
    const std::size_t lane = open.front();
    open.pop_front();
    for (const ElementId id : road.lanes[lane].successors) {
      const std::size_t next = index.at(id);
      if (previous[next] != kNone) continue;
      previous[next] = lane;
      open.push_back(next);
    }
  }
  if (previous[to] == kNone) return {};
  std::vector<std::size_t> way{to};
  do way.push_back(previous[way.back()]);
  while (way.back() != from);
  std::reverse(way.begin(), way.end());
  return way;
}

std::vector<std::size_t> long_way(const Road& road) {
  const std::map<ElementId, std::size_t> index = index_by_id(road);
  std::vector<std::vector<std::size_t>> successors;
  std::set<ElementId> lanelines;
  for (const RoadMarking& marking : road.markings) {
    if (marking.type == MarkingType::laneline) lanelines.insert(marking.id);
  }
  std::vector<double> worth_m;
  for (const RoadLane& lane : road.lanes) {
    successors.emplace_back();
    for (const ElementId id : lane.successors) successors.back().push_back(index.at(id));
    const bool marked = lanelines.contains(lane.left_marking) || lanelines.contains(lane.right_marking);
    worth_m.push_back(length(lane.centerline) * (marked ? 1.0 : kUnmarkedShare));
  }
  Random random(1);
  std::vector<std::size_t> longest;
  double longest_m = -1.0;
  for (std::size_t from = 0; from < road.lanes.size(); ++from) {
    for (int attempt = 0; attempt < kTriesPerLane; ++attempt) {
      const std::vector<std::size_t> way = wander(successors, from, random);
      double way_m = 0.0;
      for (const std::size_t lane : way) way_m += worth_m[lane];
      if (way_m <= longest_m) continue;
      longest = way;
      longest_m = way_m;
    }
  }
  return longest;
}

Polyline joined_centerlines(const Road& road, const std::vector<std::size_t>& lanes) {
  Polyline path;
  for (const std::size_t lane : lanes) {
    for (const Point& point : road.lanes[lane].centerline) {
      if (path.empty() || (point - path.back()).norm() > 1e-3) path.push_back(point);
    }
  }
  return path;
}

}  // namespace laneloom::simulation
