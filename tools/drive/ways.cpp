#include "drive/ways.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "drive/lines.hpp"

namespace laneloom {
namespace {

constexpr double kGoesOn_m = 8.0;
constexpr double kTurn_rad = 0.5;
constexpr double kTurnBack_rad = 2.6;
constexpr double kNarrowed = 0.77;

Polyline walked(Polyline line, bool against) {
  if (against) std::reverse(line.begin(), line.end());
  return line;
}

Linkage::Turn walked(Linkage::Turn turn, bool against) {
  if (against && turn == Linkage::Turn::left) return Linkage::Turn::right;
  if (against && turn == Linkage::Turn::right) return Linkage::Turn::left;
  return turn;
}

Eigen::Vector2d first_direction(const Polyline& line) { return -end_direction(line, End::front); }

/// By the directions in which a lane is left and the next one is entered.
Linkage::Turn turn_between(const Polyline& from, const Polyline& to) {
  const Eigen::Vector2d leaving = end_direction(from, End::back), entering = first_direction(to);
  const double turn_rad = std::atan2(cross(leaving, entering), leaving.dot(entering));
  if (std::abs(turn_rad) < kTurn_rad) return Linkage::Turn::straight;
  if (std::abs(turn_rad) > kTurnBack_rad) return Linkage::Turn::u_turn;
  return turn_rad > 0.0 ? Linkage::Turn::left : Linkage::Turn::right;
}

const Lane* find(const LocalMap& map, ElementId id) {
  const auto found = std::ranges::find(map.lanes, id, &Lane::id);
  return found == map.lanes.end() ? nullptr : &*found;
}

/// Whether most of the line between both may be crossed.
bool is_crossable(const Neighbour& neighbour) {
  double crossable_m = 0.0;
  for (const Stretch& range : neighbour.crossable) crossable_m += range.length();
  return crossable_m > 0.5 * neighbour.range.length();
}

/// Where a lane ends, it narrows; where only the view of it ends, it does not.
bool narrows(const Way& way) {
  const Polyline left = walked(way.lane->left, way.against), right = walked(way.lane->right, way.against);
  const MeasuredPolyline other(right);
  double widest_m = 0.0;
  for (const Point& point : left) widest_m = std::max(widest_m, other.project(point).distance_m);
  return (left.back() - right.back()).head<2>().norm() < kNarrowed * widest_m;
}

bool goes_on_beyond(const LocalMap& map, const Way& way, const Point& end) {
  const MeasuredPolyline line(way.centerline());
  const Projection foot = line.project(end);
  if (!foot.inside) return false;
  return line.length() - foot.arc_m > kGoesOn_m || !passages(map, way).empty();
}

}  // namespace

Polyline Way::centerline() const { return walked(lane->centerline, against); }

bool Way::oncoming() const {
  return lane->direction ==
         (against ? Lane::Direction::along_centerline : Lane::Direction::against_centerline);
}

std::vector<Passage> passages(const LocalMap& map, const Way& way) {
  std::vector<Passage> all;
  for (const Linkage& linkage : map.linkages) {
    if ((way.against ? linkage.to : linkage.from) != way.lane->id) continue;
    const Lane* next = find(map, way.against ? linkage.from : linkage.to);
    if (next == nullptr) continue;
    Passage passage{{next, way.against},
                    walked(linkage.path, way.against),
                    walked(linkage.turn, way.against),
                    linkage.confidence};
    const Polyline from = way.centerline(), to = passage.to.centerline();
    if (passage.path.empty()) passage.path = bridge(from, to);
    if (passage.turn == Linkage::Turn::unknown) passage.turn = turn_between(from, to);
    all.push_back(std::move(passage));
  }
  return all;
}

const Passage* choose(const std::vector<Passage>& passages, Linkage::Turn wanted) {
  const auto worth = [wanted](const Passage& passage) {
    const bool bends = passage.turn == Linkage::Turn::left || passage.turn == Linkage::Turn::right ||
                       passage.turn == Linkage::Turn::u_turn;
    const double fit = passage.turn == wanted ? 2.0 : (bends ? 0.0 : 1.0);
    return fit + 0.9 * passage.confidence - (passage.to.oncoming() ? 1.0 : 0.0);
  };
  const auto best = std::ranges::max_element(passages, {}, worth);
  return best == passages.end() ? nullptr : &*best;
}

Way beside(const LocalMap& map, const Way& way) {
  if (!narrows(way)) return {};
  const Lane& lane = *way.lane;
  const Point end = way.centerline().back();
  for (const auto* neighbours : {&lane.left_neighbours, &lane.right_neighbours}) {
    for (const Neighbour& neighbour : *neighbours) {
      const Way candidate{find(map, neighbour.lane), way.against};
      if (candidate.lane == nullptr || candidate.oncoming() || !is_crossable(neighbour)) continue;
      if (goes_on_beyond(map, candidate, end)) return candidate;
    }
  }
  return {};
}

}  // namespace laneloom
