#include "mapping/lanes/way_passages.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "mapping/geometry/levels.hpp"
#include "mapping/lanes/lane_ahead.hpp"
#include "mapping/lanes/lane_geometry.hpp"

namespace laneloom::lanes {
namespace {

using Turn = Linkage::Turn;

constexpr double kBranch_m = 1.5;    // that a branch lies further aside than the lane that goes on
constexpr double kLookout_m = 25.0;  // ahead of a lane's end

/// How far passages step to the left from straight ahead of a lane's end.
class StepAside {
 public:
  explicit StepAside(const DirectedLane& from) : line_(from.centerline()) {}
  double left_m(const Passage& passage) const {
    return cross(ahead_, (begin_point(passage.to) - line_.back()).head<2>());
  }

 private:
  Polyline line_;
  Eigen::Vector2d ahead_ = end_direction(line_, End::back);
};

/// Leaves out passages that step aside where another one of the same turn leads on: the branches of forks.
void leave_out_branches(const DirectedLane& from, std::vector<Passage>& passages) {
  const StepAside step(from);
  const auto aside_m = [&](const Passage& passage) { return std::abs(step.left_m(passage)); };
  const auto is_branch = [&](const Passage& one) {
    return std::ranges::any_of(passages, [&](const Passage& other) {
      return other.turn == Turn::straight && !other.to.oncoming() &&
             aside_m(one) > aside_m(other) + kBranch_m;
    });
  };
  std::vector<Passage> kept;
  std::ranges::copy_if(passages, std::back_inserter(kept), [&](const Passage& passage) {
    return passage.turn != Turn::straight || !is_branch(passage);
  });
  passages = std::move(kept);
}

bool is_offered(const std::vector<Passage>& passages, Turn turn) {
  return std::ranges::find(passages, turn, &Passage::turn) != passages.end();
}

/// Leaves, of passages that lead straight on, those furthest to the side of a turn.
void keep_branch(const DirectedLane& from, Turn side, std::vector<Passage>& passages) {
  const StepAside step(from);
  const auto to_side_m = [&](const Passage& passage) {
    return (side == Turn::left ? 1.0 : -1.0) * step.left_m(passage);
  };
  double furthest_m = -std::numeric_limits<double>::infinity();
  for (const Passage& passage : passages)
    if (passage.turn == Turn::straight && !passage.to.oncoming())
      furthest_m = std::max(furthest_m, to_side_m(passage));
  std::erase_if(passages, [&](const Passage& passage) {
    return passage.turn == Turn::straight && to_side_m(passage) < furthest_m - kBranch_m;
  });
}

/// Where a lane forks, leaves the passages of the branch that is wished.
void choose_branch(const DirectedLane& from, Turn wished, const RouteWish& wish,
                   std::vector<Passage>& passages) {
  const bool forks_off = wish.turn_m && wished != Turn::straight && !is_offered(passages, wished);
  if (forks_off)
    keep_branch(from, wished, passages);
  else
    leave_out_branches(from, passages);
}

/// The passage to take. A passage that was chosen before stays, even where its turn or its probability is
/// judged anew, unless another one makes the wished turn at last. Null: there is none.
const Passage* chosen(const std::vector<Passage>& passages, Turn wished, const Way* before) {
  const bool has_wished = is_offered(passages, wished);
  for (const Passage& passage : passages) {
    const WayLane* kept = find(before, passage.to);
    if (kept == nullptr || kept->entry == Turn::unknown) continue;
    if (!has_wished || passage.turn == wished || kept->entry == wished) return &passage;
  }
  return best_passage(passages, wished);
}

bool is_walked(const std::vector<Passage>& way, const DirectedLane& first, const Lane* lane) {
  return lane == first.lane ||
         std::ranges::any_of(way, [&](const Passage& passage) { return passage.to.lane == lane; });
}

/// Whether an edge that was seen lies across the road ahead of a lane's end.
bool is_closed_ahead(const LaneGraph& graph, const DirectedLane& lane) {
  const Polyline line = lane.centerline();
  Point ahead = line.back();
  ahead.head<2>() += kLookout_m * end_direction(line, End::back);
  return std::ranges::any_of(graph.map().boundaries, [&](const Marking& boundary) {
    return boundary.type == MarkingType::roadedge && boundary.status != ElementStatus::inferred &&
           intersect({line.back(), ahead}, boundary.points, geometry::kLevel_m);
  });
}

/// Whether a passage turns off where the road may lead straight on: across an intersection whose far side is
/// not seen yet.
bool turns_off(const LaneGraph& graph, const DirectedLane& from, const Passage& passage) {
  if (passage.turn == Turn::straight || passage.turn == Turn::unknown) return false;
  const bool bends = from.against ? is_between_the_same(*passage.to.lane, *from.lane)
                                  : is_between_the_same(*from.lane, *passage.to.lane);
  return !bends && !is_closed_ahead(graph, from);
}

/// The turn that is wished at the end of a lane, `ahead_m` ahead of the vehicle.
Turn turn_at(const RouteWish& wish, double ahead_m) {
  const bool is_there = !wish.turn_m || (wish.turn_m->from_m <= ahead_m && ahead_m <= wish.turn_m->to_m);
  return is_there ? turn_of(wish.wish) : Turn::straight;
}

}  // namespace

Turn turn_of(WayWish wish) {
  if (wish == WayWish::left) return Turn::left;
  return wish == WayWish::right ? Turn::right : Turn::straight;
}

const WayLane* find(const Way* way, const DirectedLane& lane) {
  if (way == nullptr) return nullptr;
  const auto found = std::ranges::find_if(
      way->lanes, [&](const WayLane& one) { return one.id == lane.lane->id && one.against == lane.against; });
  return found == way->lanes.end() ? nullptr : &*found;
}

Turn Passages::wished(const RouteWish& wish, double ahead_m) const {
  return has_turned ? Turn::straight : turn_at(wish, ahead_m);
}

Passages passages_ahead(const LaneGraph& graph, const RouteStart& start, const RouteWish& wish,
                        double reach_m) {
  Passages way;
  DirectedLane last = start.lane;
  for (double length_m = length(last.lane->centerline); length_m < reach_m;) {
    std::vector<Passage> next = graph.successors(last);
    const bool is_begun = way.all.empty() && start.into != kNoElement;
    const Turn wished = way.wished(wish, length_m - start.arc_m - start.passed_m);
    std::erase_if(next, [&](const Passage& passage) {
      const bool elsewhere = is_begun && passage.to.lane->id != start.into;
      const bool wrong =
          !is_begun && !wish.any_turn && passage.turn != wished && turns_off(graph, last, passage);
      return elsewhere || wrong || is_walked(way.all, start.lane, passage.to.lane) ||
             !passage.to.lane->is_drivable();
    });
    if (!is_begun) choose_branch(last, wished, wish, next);
    const Passage* best = chosen(next, wished, wish.before);
    if (best == nullptr) break;
    way.has_turned = way.has_turned || (wished != Turn::straight && best->turn == wished);
    const double gap_m = (begin_point(best->to) - last.centerline().back()).norm();
    last = best->to;
    length_m += std::max(gap_m, length(best->path)) + length(last.lane->centerline);
    way.all.push_back(*best);
  }
  return way;
}

}  // namespace laneloom::lanes
