#include "drive/closed_loop.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "drive/steering.hpp"
#include "laneloom/lane_graph.hpp"
#include "mapping/lanes/wished_turn.hpp"

namespace laneloom::drive {
namespace {

constexpr std::int64_t kPeriod_ns = 10'000'000;
constexpr std::int64_t kStepsPerTick = 10;
constexpr double kTick_s = 0.1;
constexpr double kPatience_s = 5.0;  // without a lane, before the vehicle creeps
constexpr double kCreep_mps = 2.0;
constexpr double kLooking_mps = 5.0;  // speed while it looks for the way that turns off
constexpr double kPutBack_m = 20.0;   // beyond the place where it left its lane
constexpr double kNear_m = 10.0;
constexpr double kBodyWidth_m = 1.9;
constexpr int kMaxVainRestarts = 100;  // some are expected: a drive goes on behind a lane that leads nowhere

/// Whether the lane at a place on the road, if there is one, is inferred.
bool is_inferred(const LocalMap& map, Point place) {
  place.z() = map.T_map_body.translation().z();
  const Lane* lane = LaneGraph(map).at(place);
  return lane != nullptr && lane->status == ElementStatus::inferred;
}

}  // namespace

ClosedLoop::ClosedLoop(const simulation::Road& road, ClosedLoopSpec spec, MapService& service)
    : road_(road),
      spec_(std::move(spec)),
      service_(service),
      lanes_(road),
      navigator_(road, lanes_),
      perception_(road, spec_.noise, simulation::SensorView{}, spec_.seed),
      network_(spec_.seed) {
  if (spec_.traffic) traffic_.emplace(road_, *spec_.traffic, spec_.seed);
  restart(navigator_.at_begin());
}

std::int64_t ClosedLoop::now_ns() const { return spec_.start_ns + steps_ * kPeriod_ns; }

void ClosedLoop::restart(const Navigator::Start& start) {
  const bool in_vain = score_.driven_m - std::exchange(restarted_at_m_, score_.driven_m) < 1.0;
  vain_restarts_ = in_vain ? vain_restarts_ + 1 : 0;
  if (vain_restarts_ > kMaxVainRestarts)
    throw std::runtime_error(road_.name + ": on this road the vehicle cannot drive a metre from any start");
  ++spec_.session_id;
  lanes_.place(start.lane);
  vehicle_ = start.vehicle;
  odometry_.emplace(lanes_.on_surface(vehicle_), spec_.drift);
  network_.clear();
  begun_ns_ = now_ns();
  started_ = false;
  plan_ = {};
  over_border_ = false;
  last_curvature_ = last_lateral_mps2_ = 0.0;
}

void ClosedLoop::step() {
  sense();
  if (steps_ % kStepsPerTick == 0) {
    plan();
    judge();
  }
  const Command command =
      plan_.path.empty() ? Command{} : follow(MeasuredPolyline(plan_.path), told_, wanted_speed());
  vehicle_.step(command, kPeriod_s);
  score_.driven_m += vehicle_.speed_mps * kPeriod_s;
  if (vehicle_.speed_mps == 0.0) score_.standing_s += kPeriod_s;
  score_.time_s += kPeriod_s;
  ++steps_;
}

void ClosedLoop::sense() {
  const Eigen::Isometry3d T_map_body = lanes_.on_surface(vehicle_);
  T_told_ = odometry_->move_to(T_map_body);
  const Eigen::Vector3d ahead = T_told_.linear().col(0);
  told_ = vehicle_;
  told_.rear_axle = T_told_.translation().head<2>();
  told_.heading_rad = std::atan2(ahead.y(), ahead.x());

  VehiclePose pose{.stamp_ns = now_ns(),
                   .sequence = static_cast<std::uint64_t>(steps_),
                   .session_id = spec_.session_id,
                   .position = T_told_.translation(),
                   .orientation = Eigen::Quaterniond(T_told_.linear()).normalized()};
  service_.send(pose);
  if (steps_ % kStepsPerTick == 0) {
    pose.position = T_map_body.translation();
    pose.orientation = Eigen::Quaterniond(T_map_body.linear()).normalized();
    DetectionFrame frame = perception_.observe(pose);
    frame.session_id = spec_.session_id;
    network_.put(std::move(frame), now_ns());
    if (traffic_) {
      TrackedObjects objects = traffic_->observe(pose);
      objects.session_id = spec_.session_id;
      service_.send(objects);
    }
  }
  while (const std::optional<DetectionFrame> frame = network_.take(now_ns())) service_.send(*frame, now_ns());
}

void ClosedLoop::plan() {
  const LocalMap& newest = service_.newest(now_ns());
  const LocalMap none;
  const LocalMap& map = newest.stamp_ns >= begun_ns_ ? newest : none;
  const Navigator::Turn turn = navigator_.next_turn(lanes_.on_surface(vehicle_).translation());
  if (spec_.by_published_way)
    service_.send(NextTurn{.stamp_ns = now_ns(),
                           .sequence = static_cast<std::uint64_t>(steps_),
                           .session_id = spec_.session_id,
                           .turn = turn.turn,
                           .distance_m = turn.distance_m});
  Plan next = next_plan(map, T_told_, told_.speed_mps, plan_,
                        {.wish = lanes::wish_of(turn.turn), .by_published_way = spec_.by_published_way});
  cause_ = cause_of_guess(map);
  in_inferred_lane_ = is_inferred(map, on_ground(told_.rear_axle));
  if (!started_) {
    const bool has_lane = next.support_at(on_ground(told_.rear_axle)) == Support::mapped;
    const bool impatient = static_cast<double>(now_ns() - begun_ns_) * 1e-9 > kPatience_s;
    if (!has_lane && !impatient) return;
    started_ = true;
  }
  plan_ = std::move(next);
}

double ClosedLoop::wanted_speed() const {
  const bool known = std::ranges::any_of(plan_.support, [](Support s) { return s != Support::guessed; });
  const double at_most_mps = !known ? kCreep_mps : plan_.looks_for_turn ? kLooking_mps : spec_.speed_mps;
  return std::min(at_most_mps, spec_.speed_mps);
}

Guess::Cause ClosedLoop::cause_of_guess(const LocalMap& map) const {
  const bool lanes_near = std::ranges::any_of(map.lanes, [&](const Lane& lane) {
    return MeasuredPolyline(lane.centerline).project(on_ground(told_.rear_axle)).distance_m < kNear_m;
  });
  if (lanes_.in_intersection()) return Guess::Cause::no_linkage;
  return lanes_near ? Guess::Cause::lane_ended : Guess::Cause::no_lane;
}

void ClosedLoop::judge() {
  const Support support = plan_.support_at(on_ground(told_.rear_axle));
  if (started_) count_support(support);
  const auto verdict = lanes_.move_to(vehicle_.centre(), vehicle_.direction());
  if (verdict == LaneTracker::Verdict::in_lane) {
    if (navigator_.follow(lanes_.lanes())) ++score_.missed_turns;
    if (started_) count_comfort();
    return;
  }
  if (guess_) score_.guesses.push_back(*std::exchange(guess_, std::nullopt));
  if (verdict == LaneTracker::Verdict::road_ended) {
    ++score_.road_ends;
    return restart(navigator_.back_on_drive());
  }
  score_.departures.push_back({.how = verdict,
                               .time_s = now_s(),
                               .place = lanes_.on_surface(vehicle_).translation(),
                               .lane = road_.lanes[lanes_.lanes().front()].id,
                               .in_intersection = lanes_.in_intersection(),
                               .guessed = support == Support::guessed});
  restart(navigator_.further_on(vehicle_.rear_axle, kPutBack_m));
}

void ClosedLoop::count_support(Support support) {
  const double moved_m = score_.driven_m - std::exchange(last_driven_m_, score_.driven_m);
  if (moved_m == 0.0) return;
  if (support == Support::remembered) score_.remembered_m += moved_m;
  if (support == Support::mapped && in_inferred_lane_) score_.inferred_m += moved_m;
  if (support != Support::guessed) {
    if (guess_) score_.guesses.push_back(*std::exchange(guess_, std::nullopt));
    return;
  }
  if (!guess_)
    guess_ = {.cause = cause_, .time_s = now_s(), .place = lanes_.on_surface(vehicle_).translation()};
  guess_->duration_s += kTick_s;
  guess_->distance_m += moved_m;
}

void ClosedLoop::count_comfort() {
  const double curvature = vehicle_.curvature();
  const double lateral_mps2 = vehicle_.speed_mps * vehicle_.speed_mps * curvature;
  score_.lateral_m.add(std::abs(lanes_.offset_m()));
  score_.lateral_mps2.add(std::abs(lateral_mps2));
  score_.jerk_mps3.add(std::abs(lateral_mps2 - std::exchange(last_lateral_mps2_, lateral_mps2)) / kTick_s);
  score_.curvature_rate.add(std::abs(curvature - std::exchange(last_curvature_, curvature)) / kTick_s);
  const bool over = std::abs(lanes_.offset_m()) + 0.5 * kBodyWidth_m > 0.5 * lanes_.width_m();
  if (over && !over_border_) ++score_.border_crossings;
  over_border_ = over;
}

DriveScore ClosedLoop::score() const {
  DriveScore score = score_;
  if (guess_) score.guesses.push_back(*guess_);
  return score;
}

}  // namespace laneloom::drive
