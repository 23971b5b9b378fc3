#include "export/gates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace laneloom::exports {
namespace {

constexpr double kSnap_m = 2.0;           // cuts that are nearer are one
constexpr double kMinStyle_m = 5.0;       // a shorter stretch of another style is noise
constexpr double kMaxSkew_m = 8.0;        // along the lane, between the two cuts of a gate
constexpr std::size_t kCutsPerMetre = 2;  // limit; cuts may chase one another round a road

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

std::map<ElementId, std::size_t> indices(const std::vector<Marking>& boundaries) {
  std::map<ElementId, std::size_t> indices;
  for (const Marking& boundary : boundaries) indices.emplace(boundary.id, indices.size());
  return indices;
}

Stretch sorted(double a, double b) { return {std::min(a, b), std::max(a, b)}; }

bool inside(double arc_m, const Stretch& range) { return range.from_m < arc_m && arc_m < range.to_m; }

}  // namespace

Gates::Gates(const LocalMap& map)
    : map_(map), beside_(map.boundaries.size()), order_(map.boundaries.size()), gates_(map.lanes.size()) {
  const std::map<ElementId, std::size_t> index = indices(map.boundaries);
  for (const Marking& boundary : map.boundaries) courses_.emplace_back(boundary.points);
  for (std::size_t i = 0; i < map.lanes.size(); ++i) {
    const Lane& lane = map.lanes[i];
    const auto side = [&](const Border& border) {
      const Stretch& range = border.on_boundary;
      return SideOfLane{.boundary = index.at(border.boundary),
                        .reversed = border.reversed,
                        .begin_m = border.reversed ? range.to_m : range.from_m,
                        .end_m = border.reversed ? range.from_m : range.to_m};
    };
    sides_.push_back({side(lane.left_borders.front()), side(lane.right_borders.front())});
    for (const bool left : {true, false}) beside_[boundary_of(i, left)].emplace_back(i, left);
  }
  for (std::size_t i = 0; i < map.lanes.size(); ++i) {
    Gate begin, end;
    for (const bool left : {true, false}) {
      const SideOfLane& side = sides_[i][left ? 0 : 1];
      (left ? begin.left : begin.right) = snap(side.boundary, side.begin_m, {-kUnbounded, kUnbounded});
      const double begin_m = arc(begin, left);
      const Stretch behind = side.reversed ? Stretch{-kUnbounded, begin_m} : Stretch{begin_m, kUnbounded};
      (left ? end.left : end.right) = snap(side.boundary, side.end_m, behind);
    }
    gates_[i] = {begin, end};
  }
}

std::size_t Gates::create(std::size_t boundary, double arc_m) {
  cuts_.push_back({boundary, arc_m});
  order_[boundary].emplace(arc_m, cuts_.size() - 1);
  to_carry_.push_back(cuts_.size() - 1);
  return cuts_.size() - 1;
}

std::size_t Gates::snap(std::size_t boundary, double arc_m, const Stretch& between) {
  const std::map<double, std::size_t>& order = order_[boundary];
  std::optional<std::size_t> nearest;
  double nearest_m = kSnap_m;
  for (auto at = order.lower_bound(arc_m - kSnap_m); at != order.end() && at->first <= arc_m + kSnap_m;
       ++at) {
    const double distance_m = std::abs(at->first - arc_m);
    if (distance_m > nearest_m || !inside(at->first, between)) continue;
    nearest = at->second;
    nearest_m = distance_m;
  }
  if (nearest) return *nearest;
  const double low_m = std::max(between.from_m, 0.0),
               high_m = std::min(between.to_m, courses_[boundary].length());
  double at_m = std::clamp(arc_m, low_m, high_m);
  if (!inside(at_m, between)) at_m = 0.5 * (low_m + high_m);
  return create(boundary, at_m);
}

double Gates::across(std::size_t lane, bool left, std::size_t cut, const Stretch& between,
                     double share) const {
  const Projection foot = courses_[boundary_of(lane, !left)].project(position(cut));
  const double width_m = map_.lanes[lane].width_m;
  if (inside(foot.arc_m, between) && foot.distance_m < width_m + kMaxSkew_m) return foot.arc_m;
  return between.from_m + share * between.length();
}

const Gates::Gate* Gates::pass(std::size_t lane, bool left, std::size_t cut) {
  std::vector<Gate>& gates = gates_[lane];
  const double arc_m = cuts_[cut].arc_m;
  for (std::size_t i = 0; i + 1 < gates.size(); ++i) {
    if (cut_of(gates[i], left) == cut) return &gates[i];
    const double from_m = arc(gates[i], left), to_m = arc(gates[i + 1], left);
    if (!inside(arc_m, sorted(from_m, to_m))) continue;
    const double other_from_m = arc(gates[i], !left), other_to_m = arc(gates[i + 1], !left);
    double share = (arc_m - from_m) / (to_m - from_m);
    if (other_to_m < other_from_m) share = 1.0 - share;
    const Stretch between = sorted(other_from_m, other_to_m);
    const std::size_t other =
        snap(boundary_of(lane, !left), across(lane, left, cut, between, share), between);
    const Gate gate = left ? Gate{cut, other} : Gate{other, cut};
    return &*gates.insert(gates.begin() + static_cast<std::ptrdiff_t>(i + 1), gate);
  }
  return nullptr;
}

Gates::Gate Gates::add_within(std::size_t lane, double behind_begin_m) {
  const double begin_m = arc(gates_[lane].front(), true), end_m = arc(gates_[lane].back(), true);
  const double step_m = std::min(behind_begin_m, 0.5 * std::abs(end_m - begin_m));
  const double at_m = end_m > begin_m ? begin_m + step_m : begin_m - step_m;
  return *pass(lane, true, snap(boundary_of(lane, true), at_m, sorted(begin_m, end_m)));
}

void Gates::cut_at_styles() {
  for (std::size_t i = 0; i < map_.boundaries.size(); ++i) {
    if (beside_[i].empty()) continue;
    const StyleRange* last = nullptr;
    for (const StyleRange& part : map_.boundaries[i].styles) {
      if (part.range.length() < kMinStyle_m) continue;
      if (last != nullptr && last->style != part.style)
        snap(i, 0.5 * (last->range.to_m + part.range.from_m), {-kUnbounded, kUnbounded});
      last = &part;
    }
  }
}

void Gates::carry_across() {
  double total_m = 0.0;
  for (const MeasuredPolyline& course : courses_) total_m += course.length();
  const std::size_t limit = cuts_.size() + kCutsPerMetre * static_cast<std::size_t>(total_m);
  while (!to_carry_.empty() && cuts_.size() < limit) {
    const std::size_t cut = to_carry_.front();
    to_carry_.pop_front();
    for (const auto& [lane, left] : beside_[cuts_[cut].boundary]) pass(lane, left, cut);
  }
}

}  // namespace laneloom::exports
