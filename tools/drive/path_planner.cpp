#include "drive/path_planner.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "drive/lines.hpp"
#include "drive/ways.hpp"
#include "laneloom/polyline.hpp"
#include "mapping/geometry/left_of.hpp"
#include "mapping/geometry/smooth_step.hpp"

namespace laneloom::drive {
namespace {

constexpr double kStep_m = 0.5;
constexpr double kBehind_m = 12.0;  // enough to tell a bend from noise
constexpr double kHorizon_m = 45.0;
// These decide on which lane a plan runs.
constexpr double kMaxPathLateral_m = 1.6;
constexpr double kMinPathAlignment = 0.8;  // cosine
constexpr double kCompared_m = 12.0;
constexpr double kCostPerMetreAhead = 0.1;
constexpr double kCostOfOncoming_m = 1.0;
constexpr double kPreview_m = 3.0;
constexpr double kMaxOffPath_m = 0.4;
constexpr double kLookForTurn_m = 20.0;  // before the lane's end
// These decide how a plan bends to the way.
constexpr double kMinBlend_m = 12.0;
constexpr double kBlend_s = 2.0;
constexpr double kMaxSlope = 0.5;
constexpr double kMinGap_m = 2.0;

/// The previous plan, cut off behind the vehicle, and prolonged ahead of it if need be.
Plan carried_on(const Bicycle& vehicle, Plan plan) {
  if (plan.path.empty()) {
    const Eigen::Vector2d back = vehicle.rear_axle - kBehind_m * vehicle.direction();
    plan.path = {on_ground(back), on_ground(back + kStep_m * vehicle.direction())};
    plan.support.assign(2, Support::guessed);
  }
  const double behind_m = MeasuredPolyline(plan.path).project(on_ground(vehicle.rear_axle)).arc_m - kBehind_m;
  const std::vector<double> arcs_m = arc_lengths(plan.path);
  const auto shed = std::max<std::ptrdiff_t>(
      0, std::upper_bound(arcs_m.begin(), arcs_m.end(), behind_m) - arcs_m.begin() - 1);
  plan.path.erase(plan.path.begin(), plan.path.begin() + shed);
  plan.support.erase(plan.support.begin(), plan.support.begin() + shed);
  std::ranges::replace(plan.support, Support::mapped, Support::remembered);
  prolong(plan.path, kHorizon_m + kBehind_m - length(plan.path), kStep_m);
  plan.support.resize(plan.path.size(), Support::guessed);
  return plan;
}

/// The place where a plan enters a lane of the map.
struct Entry {
  DirectedLane way;
  double arc_m = 0.0;    ///< arc length on the way
  double ahead_m = 0.0;  ///< distance ahead of the vehicle
  double cost_m = 0.0;
  bool between = false;  ///< the vehicle is on the passage behind the way
};

std::optional<Entry> entry_into(const Lane& lane, const MeasuredPolyline& track, double vehicle_m) {
  const MeasuredPolyline line(lane.centerline);
  std::optional<Entry> entry;
  double lateral_m = 0.0;
  int samples = 0;
  for (double ahead_m = 0.0; ahead_m <= kHorizon_m; ahead_m += 1.0) {
    if (entry && ahead_m > entry->ahead_m + kCompared_m) break;
    const Projection foot = line.project(track.at(vehicle_m + ahead_m));
    const double along = line.direction(foot.arc_m).dot(track.direction(vehicle_m + ahead_m));
    if (!foot.inside || foot.distance_m > kMaxPathLateral_m || std::abs(along) < kMinPathAlignment) continue;
    const bool against = along < 0.0;
    if (!entry) entry = {{&lane, against}, against ? line.length() - foot.arc_m : foot.arc_m, ahead_m};
    if (entry->way.against != against) continue;
    lateral_m += foot.distance_m;
    ++samples;
  }
  if (entry)
    entry->cost_m = lateral_m / samples + kCostPerMetreAhead * entry->ahead_m +
                    (entry->way.oncoming() ? kCostOfOncoming_m : 0.0);
  return entry;
}

const Passage* find(const std::vector<Passage>& all, ElementId into) {
  const auto found = std::ranges::find(all, into, [](const Passage& passage) { return passage.to.lane->id; });
  return found == all.end() ? nullptr : &*found;
}

/// The entry onto the passage that the vehicle has begun. None: the map no longer has the passage, or the
/// vehicle is not on it.
std::optional<Entry> on_passage(const LaneGraph& graph, const Passing& passing, const Point& vehicle) {
  const Lane* const from = graph.find(passing.from);
  if (from == nullptr) return std::nullopt;
  const DirectedLane way{from, passing.against};
  const std::vector<Passage> all = passages(graph, way);
  const Passage* const begun = find(all, passing.into);
  if (begun == nullptr || begun->path.empty()) return std::nullopt;
  const Projection foot = MeasuredPolyline(begun->path).project(vehicle);
  if (!foot.inside || foot.distance_m > kMaxPathLateral_m) return std::nullopt;
  return Entry{.way = way, .arc_m = length(from->centerline), .between = true};
}

/// The entry onto the lane that the track runs on, or the nearest one ahead. Between lanes, it is onto the
/// passage that was begun, or the lane into which that led.
std::optional<Entry> find_entry(const LaneGraph& graph, const MeasuredPolyline& track, double vehicle_m,
                                const Passing& passing) {
  std::optional<Entry> best, after;
  for (const Lane& lane : graph.map().lanes) {
    const std::optional<Entry> entry = entry_into(lane, track, vehicle_m);
    if (entry && (!best || entry->cost_m < best->cost_m)) best = entry;
    if (entry && lane.id == passing.from && entry->ahead_m == 0.0) return entry;
    if (entry && lane.id == passing.into) after = entry;
  }
  if (after && after->ahead_m == 0.0) return after;
  if (const auto between = on_passage(graph, passing, track.at(vehicle_m))) return between;
  return after && passing.between ? after : best;
}

/// Whether the vehicle can still take a passage: if it went straight on, it would not leave the path too
/// soon.
bool can_take(const Passage& passage, const Bicycle& vehicle) {
  if (passage.path.size() < 2) return true;
  const Eigen::Vector2d ahead = vehicle.rear_axle + kPreview_m * vehicle.direction();
  const Projection foot = MeasuredPolyline(passage.path).project(on_ground(ahead));
  return foot.distance_m < kMaxOffPath_m || (!foot.inside && foot.arc_m == 0.0);
}

/// The best passage for the wanted turn. If another passage was begun, and the best one can no longer be
/// taken, it is the one that was begun. Null: there is no passage.
const Passage* next_passage(const std::vector<Passage>& all, ElementId begun, const Bicycle& vehicle,
                            Linkage::Turn wanted) {
  const Passage* const wished = best_passage(all, wanted);
  const Passage* const kept = find(all, begun);
  return kept == nullptr || can_take(*wished, vehicle) ? wished : kept;
}

bool is_bend(Linkage::Turn turn) { return turn == Linkage::Turn::left || turn == Linkage::Turn::right; }

/// The centerlines and paths ahead, beginning a little behind an entry.
Polyline way_ahead(const LaneGraph& graph, const Entry& entry, const Bicycle& vehicle, Linkage::Turn wanted,
                   Plan& plan) {
  DirectedLane way = entry.way;
  const MeasuredPolyline first(way.centerline());
  Polyline line = first.slice({std::max(0.0, entry.arc_m - kBehind_m), first.length()});
  const double end_m = entry.ahead_m + first.length() - entry.arc_m;
  const ElementId begun = way.lane->id == plan.passing.from ? plan.passing.into : kNoElement;
  const bool arrives = plan.passing.between && way.lane->id == plan.passing.into && entry.ahead_m > 0.0;
  if (!arrives) plan.passing = {};
  std::set<ElementId> walked;
  while (length(line) < kHorizon_m + kBehind_m && walked.insert(way.lane->id).second) {
    const std::vector<Passage> all = passages(graph, way);
    const Passage* const passage =
        next_passage(all, walked.size() == 1 ? begun : kNoElement, vehicle, wanted);
    if (walked.size() == 1) {
      const bool found = passage != nullptr && (passage->path.empty() || passage->turn == wanted);
      plan.looks_for_turn = is_bend(wanted) && end_m < kLookForTurn_m && !found;
      if (passage != nullptr && entry.ahead_m == 0.0)
        plan.passing = {way.lane->id, way.against, passage->to.lane->id, entry.between};
    }
    if (passage != nullptr) {
      append(line, passage->path);
      append(line, passage->to.centerline());
      if (passage->turn == wanted) wanted = Linkage::Turn::straight;  // that intersection is passed
      way = passage->to;
    } else if (const DirectedLane other = lane_to_change_to(graph, way); other.lane != nullptr) {
      line = change_over(line, other.centerline());
      way = other;
    } else {
      break;
    }
  }
  return line;
}

/// Continues `way` along the earlier plan, beginning at the end of `way` without a step.
void remember(const Plan& earlier, Plan& way) {
  const MeasuredPolyline track(earlier.path);
  const Projection foot = track.project(way.path.back());
  if (!foot.inside || foot.distance_m > kMaxPathLateral_m) return;
  const Point shift = way.path.back() - foot.foot;
  const std::vector<double> arcs_m = arc_lengths(earlier.path);
  for (std::size_t i = 0; i < earlier.path.size(); ++i) {
    const double beyond_m = arcs_m[i] - foot.arc_m;
    if (beyond_m < kStep_m) continue;
    if (earlier.support[i] == Support::guessed) break;
    way.path.emplace_back(earlier.path[i] + (1.0 - geometry::smooth_step(beyond_m / kMinBlend_m)) * shift);
    way.support.push_back(Support::remembered);
  }
}

/// The way on the map from an entry, or a little behind it, to the horizon.
Plan way_of(const LaneGraph& graph, const Entry& entry, const Bicycle& vehicle, const Plan& earlier,
            Linkage::Turn wanted) {
  Plan way{.passing = earlier.passing};
  way.path = smoothed(MeasuredPolyline(way_ahead(graph, entry, vehicle, wanted, way)).resample(kStep_m));
  way.support.assign(way.path.size(), Support::mapped);
  remember(earlier, way);
  prolong(way.path, kHorizon_m + kBehind_m - length(way.path), kStep_m);
  way.support.resize(way.path.size(), Support::guessed);
  return way;
}

/// The lateral offset of a bend from one line to another: a cubic that begins with the track's offset and
/// slope, and ends with none.
class Blend {
 public:
  Blend(double offset_m, double slope, double length_m)
      : offset_m_(offset_m), slope_(std::clamp(slope, -kMaxSlope, kMaxSlope)), length_m_(length_m) {}
  double offset_at(double s_m) const {
    const double t = std::clamp(s_m / length_m_, 0.0, 1.0);
    return offset_m_ * (1.0 - geometry::smooth_step(t)) + slope_ * length_m_ * t * (1.0 - t) * (1.0 - t);
  }

 private:
  double offset_m_, slope_, length_m_;
};

Plan until(const Plan& plan, double arc_m) {
  const std::vector<double> arcs_m = arc_lengths(plan.path);
  const auto kept = std::lower_bound(arcs_m.begin(), arcs_m.end(), arc_m - 0.3 * kStep_m) - arcs_m.begin();
  return {{plan.path.begin(), plan.path.begin() + kept}, {plan.support.begin(), plan.support.begin() + kept}};
}

/// Extends `plan`, which ends at `from_m` of the track, along `way`, ever nearer to it.
void approach(const MeasuredPolyline& track, double from_m, double blend_m, const Plan& way, Plan& plan) {
  const MeasuredPolyline line(way.path);
  const Projection foot = line.project(track.at(from_m));
  const Eigen::Vector2d along = line.direction(foot.arc_m), now = track.direction(from_m);
  const Blend blend(foot.lateral_m, cross(along, now) / std::max(0.1, along.dot(now)), blend_m);
  for (double arc_m = foot.arc_m; arc_m <= line.length(); arc_m += kStep_m) {
    plan.path.push_back(
        geometry::beside(line.at(arc_m), line.direction(arc_m), blend.offset_at(arc_m - foot.arc_m)));
    plan.support.push_back(way.support_at(line.at(arc_m)));
  }
}

/// Extends `plan`, which ends at `from_m` of the track, by a bend and by the way from the bend's end on.
void bend_over(const MeasuredPolyline& track, double from_m, double bend_m, const Plan& way, Plan& plan) {
  const MeasuredPolyline line(way.path);
  const double to_m = line.project(track.at(from_m + bend_m)).arc_m;
  for (const Point& point :
       bend_between(track.at(from_m), track.direction(from_m), line.at(to_m), line.direction(to_m))) {
    plan.path.push_back(point);
    plan.support.push_back(Support::mapped);
  }
  for (double arc_m = to_m + kStep_m; arc_m <= line.length(); arc_m += kStep_m) {
    plan.path.push_back(line.at(arc_m));
    plan.support.push_back(way.support_at(line.at(arc_m)));
  }
}

}  // namespace

Support Plan::support_at(const Point& place) const {
  if (path.empty()) return Support::guessed;
  const auto distance = [&](const Point& point) { return (point - place).head<2>().squaredNorm(); };
  const auto nearest = std::ranges::min_element(path, {}, distance);
  return support[static_cast<std::size_t>(nearest - path.begin())];
}

Plan next_plan(const LocalMap& map, const Bicycle& vehicle, const Plan& previous, Linkage::Turn wanted) {
  Plan earlier = carried_on(vehicle, previous);
  const MeasuredPolyline track(earlier.path);
  const double vehicle_m = track.project(on_ground(vehicle.rear_axle)).arc_m;
  const LaneGraph graph(map);
  const std::optional<Entry> entry = find_entry(graph, track, vehicle_m, previous.passing);
  if (!entry) return earlier;
  const Plan way = way_of(graph, *entry, vehicle, earlier, wanted);
  const double blend_m = std::max(kMinBlend_m, kBlend_s * vehicle.speed_mps);
  // The plan stays unchanged up to shortly before the entry.
  const double from_m = vehicle_m + std::max(0.0, entry->ahead_m - blend_m);
  Plan next = until(earlier, from_m);
  next.passing = way.passing;
  next.looks_for_turn = way.looks_for_turn;
  const std::size_t kept = next.path.size();
  if (entry->ahead_m > kMinGap_m)
    bend_over(track, from_m, blend_m, way, next);
  else
    approach(track, from_m, blend_m, way, next);
  for (std::size_t i = kept; i < next.path.size(); ++i) {
    const Projection foot = track.project(next.path[i]);
    if (foot.arc_m < vehicle_m + entry->ahead_m - kStep_m) next.support[i] = earlier.support_at(foot.foot);
  }
  return next;
}

}  // namespace laneloom::drive
