#include "drive/path_planner.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "drive/lines.hpp"
#include "laneloom/polyline.hpp"
#include "laneloom/way.hpp"
#include "mapping/geometry/left_of.hpp"
#include "mapping/geometry/smooth_step.hpp"
#include "mapping/lanes/way_passages.hpp"

namespace laneloom::drive {
namespace {

constexpr double kStep_m = 0.5;
constexpr double kBehind_m = 12.0;  // enough to tell a bend from noise
constexpr double kHorizon_m = 45.0;
constexpr double kMaxOffTrack_m = 1.6;   // of an earlier plan that goes on where the way ends
constexpr double kLookForTurn_m = 20.0;  // before the lane's end
// These decide how a plan bends to the way.
constexpr double kMinBlend_m = 12.0;
constexpr double kBlend_s = 2.0;
constexpr double kMaxSlope = 0.5;
constexpr double kMinGap_m = 2.0;
constexpr double kTangent_m = 1.0;

/// The previous plan, cut off behind the vehicle, and prolonged ahead of it if need be.
Plan carried_on(const Eigen::Isometry3d& T_map_body, Plan plan) {
  const Point place = T_map_body.translation();
  if (plan.path.empty()) {
    const Point ahead = T_map_body.linear().col(0);
    plan.path = {place - kBehind_m * ahead, place - (kBehind_m - kStep_m) * ahead};
    plan.support.assign(2, Support::guessed);
  }
  const double behind_m = MeasuredPolyline(plan.path).project(place).arc_m - kBehind_m;
  const std::vector<double> arcs_m = arc_lengths(plan.path);
  const auto shed = std::max<std::ptrdiff_t>(
      0, std::upper_bound(arcs_m.begin(), arcs_m.end(), behind_m) - arcs_m.begin() - 1);
  plan.path.erase(plan.path.begin(), plan.path.begin() + shed);
  plan.support.erase(plan.support.begin(), plan.support.begin() + shed);
  std::ranges::replace(plan.support, Support::mapped, Support::remembered);
  prolong(plan.path, kHorizon_m + kBehind_m - length(plan.path), kStep_m);
  plan.support.resize(plan.path.size(), Support::guessed);
  plan.looks_for_turn = false;
  return plan;
}

/// The first way that begins on a track.
struct Entry {
  Way way;
  double ahead_m = 0.0;  ///< distance of its beginning from the vehicle, along the track
};

/// Whether a way leads against the traffic of its first lane.
bool is_oncoming(const LaneGraph& graph, const Way& way) {
  if (way.lanes.empty()) return false;
  const auto [id, against, entry, range] = way.lanes.front();
  return graph.find(id)->direction ==
         (against ? Lane::Direction::along_centerline : Lane::Direction::against_centerline);
}

/// A way against the traffic is taken if there is no other, and the track itself is but a guess.
std::optional<Entry> find_entry(const LaneGraph& graph, const Plan& earlier, const MeasuredPolyline& track,
                                double vehicle_m, WayWish wish) {
  std::optional<Entry> oncoming, street;
  for (double ahead_m = 0.0; ahead_m < kHorizon_m; ahead_m += 1.0) {
    const Eigen::Vector2d along = track.direction(vehicle_m + ahead_m);
    Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
    place.translation() = track.at(vehicle_m + ahead_m);
    place.rotate(Eigen::AngleAxisd(std::atan2(along.y(), along.x()), Eigen::Vector3d::UnitZ()));
    auto way = way_ahead(graph, place, wish, earlier.way ? &*earlier.way : nullptr,
                         {.reach_m = kHorizon_m, .step_m = kStep_m});
    // A way without lanes is what is left of the way before, or the street's.
    if (ahead_m == 0.0 && way && way->lanes.empty() && way->stations.front().lateral_stddev_m >= 0.0)
      street = Entry{*way, ahead_m};
    if (!way || way->lanes.empty() || (ahead_m > 0.0 && way->stations.front().lane == kNoElement)) continue;
    if (!is_oncoming(graph, *way)) return Entry{std::move(*way), ahead_m};
    if (!oncoming) oncoming = Entry{std::move(*way), ahead_m};
  }
  if (street) return street;
  return earlier.support_at(track.at(vehicle_m)) == Support::guessed ? oncoming : std::nullopt;
}

/// The way of the map, which begins beside the vehicle.
std::optional<Entry> published_entry(const LocalMap& map) {
  return map.way ? std::optional(Entry{.way = *map.way}) : std::nullopt;
}

/// Whether the lane of the vehicle ends soon, and no turn as it is wished follows it.
bool looks_for_turn(const Entry& entry, WayWish wish) {
  if (wish != WayWish::left && wish != WayWish::right) return false;
  const Linkage::Turn turn = lanes::turn_of(wish);
  const std::vector<WayLane>& lanes = entry.way.lanes;
  if (lanes.empty() || std::ranges::find(lanes, turn, &WayLane::entry) != lanes.end()) return false;
  const double end_m = lanes.front().range.to_m;
  const bool leads_on = lanes.size() > 1 && lanes[1].range.from_m < end_m + kMinGap_m;
  return entry.ahead_m + end_m < kLookForTurn_m && !leads_on;
}

/// Continues `plan` along the earlier one, beginning at its end without a step.
void remember(const Plan& earlier, Plan& plan) {
  const MeasuredPolyline track(earlier.path);
  const Projection foot = track.project(plan.path.back());
  if (!foot.inside || foot.distance_m > kMaxOffTrack_m) return;
  const Point shift = plan.path.back() - foot.foot;
  const std::vector<double> arcs_m = arc_lengths(earlier.path);
  for (std::size_t i = 0; i < earlier.path.size(); ++i) {
    const double beyond_m = arcs_m[i] - foot.arc_m;
    if (beyond_m < kStep_m) continue;
    if (earlier.support[i] == Support::guessed) break;
    plan.path.emplace_back(earlier.path[i] + (1.0 - geometry::smooth_step(beyond_m / kMinBlend_m)) * shift);
    plan.support.push_back(Support::remembered);
  }
}

/// The path along a way, to the horizon.
Plan plan_along(const Way& way, const Plan& earlier) {
  Plan plan;
  for (const WayStation& station : way.stations) plan.path.push_back(station.point);
  plan.support.assign(plan.path.size(), Support::mapped);
  remember(earlier, plan);
  prolong(plan.path, kHorizon_m - length(plan.path), kStep_m);
  plan.support.resize(plan.path.size(), Support::guessed);
  return plan;
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
  return {.path = {plan.path.begin(), plan.path.begin() + kept},
          .support = {plan.support.begin(), plan.support.begin() + kept}};
}

/// Extends `plan`, which ends at `from_m` of the track, along `way`, ever nearer to it.
void approach(const MeasuredPolyline& track, double from_m, double blend_m, const Plan& way, Plan& plan) {
  const MeasuredPolyline line(way.path);
  const Projection foot = line.project(track.at(from_m));
  // Chords over the same length, since in a bend the directions of segments differ by where the vertices lie.
  const Eigen::Vector2d along = line.chord(foot.arc_m, foot.arc_m + kTangent_m);
  const Eigen::Vector2d now = track.chord(from_m, from_m + kTangent_m);
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

Plan next_plan(const LocalMap& map, const Eigen::Isometry3d& T_map_body, double speed_mps,
               const Plan& previous, const Guide& guide) {
  Plan earlier = carried_on(T_map_body, previous);
  const MeasuredPolyline track(earlier.path);
  const double vehicle_m = track.project(T_map_body.translation()).arc_m;
  const std::optional<Entry> entry = guide.by_published_way
                                         ? published_entry(map)
                                         : find_entry(LaneGraph(map), earlier, track, vehicle_m, guide.wish);
  if (!entry) return earlier;
  const Plan way = plan_along(entry->way, earlier);
  const double blend_m = std::max(kMinBlend_m, kBlend_s * speed_mps);
  // The plan stays unchanged up to shortly before the entry.
  const double from_m = vehicle_m + std::max(0.0, entry->ahead_m - blend_m);
  Plan next = until(earlier, from_m);
  next.way = entry->way;
  next.looks_for_turn = looks_for_turn(*entry, guide.wish);
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
