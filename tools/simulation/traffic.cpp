#include "simulation/traffic.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

#include "base/seconds.hpp"

namespace laneloom::simulation {
namespace {

constexpr double kReach_m = 75.0;     // vehicles further away are gone
constexpr double kSeen_m = 60.0;      // and those further than this are not seen
constexpr double kEntrance_m = 50.0;  // new ones come into view beyond this
constexpr double kClose_m = 6.0;      // nearer to the own vehicle, there is none
constexpr double kFramePeriod_s = 0.1;
constexpr double kMaxStep_s = 1.0;
constexpr double kMemory_s = 1.0;   // of the tracker's errors that do not last
constexpr double kShift_mps = 1.2;  // to the side, in a manoeuvre
constexpr double kOvertaking_s = 4.0;
constexpr double kParked_m = 2.3;    // to the right of the middle of a lane
constexpr double kWrongWay_m = 1.2;  // likewise
constexpr double kCyclist_mps = 5.0;
constexpr double kGhost_s = 1.0;

Point to_left(const Eigen::Vector2d& direction) { return {-direction.y(), direction.x(), 0.0}; }

}  // namespace

TrafficProfile traffic_profile(const std::string& name) {
  TrafficProfile profile;
  if (name == "usual") return profile;
  if (name == "exact") {
    profile.position_stddev_m = profile.position_stddev_per_m = profile.heading_stddev_rad = 0.0;
    profile.flipped_share = profile.missed_share = profile.ghosts = 0.0;
    profile.id_period_s = 1e9;
    return profile;
  }
  if (name != "hostile") throw std::invalid_argument("there is no traffic '" + name + "'");
  profile.wrong_way_share = 0.1;
  profile.lane_changes_per_s = 0.15;
  profile.overtakings_per_s = 0.02;
  profile.parked_per_km = 60.0;
  profile.position_stddev_m = 0.9;
  profile.position_stddev_per_m = 0.06;
  profile.heading_stddev_rad = 0.15;
  profile.flipped_share = 0.05;
  profile.id_period_s = 2.0;
  profile.missed_share = 0.15;
  profile.ghosts = 1.0;
  return profile;
}

std::vector<std::string> traffic_profile_names() { return {"exact", "usual", "hostile"}; }

Traffic::Traffic(const Road& road, TrafficProfile profile, std::uint64_t seed)
    : profile_(profile), random_(seed), lanes_(road.lanes), successors_(road.lanes.size()) {
  std::map<ElementId, std::size_t> index;
  for (std::size_t i = 0; i < lanes_.size(); ++i) index.emplace(lanes_[i].id, i);
  for (std::size_t i = 0; i < lanes_.size(); ++i) {
    lines_.emplace_back(lanes_[i].centerline);
    for (const ElementId successor : lanes_[i].successors) successors_[i].push_back(index.at(successor));
  }
}

TrackedObjects Traffic::observe(const VehiclePose& pose) {
  double dt_s = last_stamp_ns_ ? seconds(pose.stamp_ns - *last_stamp_ns_) : kFramePeriod_s;
  if (!(dt_s > 0.0 && dt_s <= kMaxStep_s)) dt_s = kFramePeriod_s;
  for (Vehicle& vehicle : vehicles_) drive(vehicle, dt_s);
  const auto is_gone = [&](const Vehicle& vehicle) {
    const bool ended = vehicle.lane == lanes_.size();
    const double away_m = ended ? 0.0 : (position(vehicle) - pose.position).head<2>().norm();
    return ended || away_m > kReach_m || away_m < kClose_m;
  };
  std::erase_if(vehicles_, is_gone);
  spawn(pose.position, last_stamp_ns_ ? kEntrance_m : kClose_m);
  haunt(pose.position, dt_s);
  last_stamp_ns_ = pose.stamp_ns;

  const Eigen::Isometry3d T_body_map = transform(pose).inverse();
  TrackedObjects seen{.stamp_ns = pose.stamp_ns, .sequence = ++sequence_, .session_id = 1, .objects = {}};
  for (Vehicle& vehicle : vehicles_)
    if (const auto object = track(vehicle, T_body_map, dt_s)) seen.objects.push_back(*object);
  for (const Ghost& ghost : ghosts_)
    seen.objects.push_back({.id = ghost.id,
                            .kind = ObjectKind::car,
                            .existence_probability = 0.6,
                            .position = T_body_map * ghost.position,
                            .heading = T_body_map.linear() * ghost.velocity.normalized(),
                            .speed_mps = ghost.velocity.norm()});
  constexpr std::size_t kMaxObjects = 256;  // of a message
  if (seen.objects.size() > kMaxObjects) seen.objects.resize(kMaxObjects);
  return seen;
}

/// Adds vehicles on lanes about the own vehicle, up to the wanted density.
void Traffic::spawn(const Point& ego, double nearest_m) {
  std::vector<std::size_t> lane_of_metre;  // of all metres of lanes that are near
  std::vector<double> arc_of_metre;
  std::size_t within = 0;  // metres within reach
  for (std::size_t i = 0; i < lanes_.size(); ++i) {
    for (double arc_m = 0.5; arc_m < lines_[i].length(); arc_m += 1.0) {
      const double away_m = (lines_[i].at(arc_m) - ego).head<2>().norm();
      if (away_m > kReach_m) {
        arc_m += away_m - kReach_m;
        continue;
      }
      ++within;
      if (away_m < nearest_m) continue;
      lane_of_metre.push_back(i);
      arc_of_metre.push_back(arc_m);
    }
  }
  const double wanted_per_km = profile_.vehicles_per_km + profile_.parked_per_km;
  const auto wanted = static_cast<std::size_t>(wanted_per_km * static_cast<double>(within) * 1e-3 + 0.5);
  while (vehicles_.size() < wanted && !lane_of_metre.empty()) {
    const std::size_t at = random_.below(lane_of_metre.size());
    Vehicle vehicle{.lane = lane_of_metre[at],
                    .arc_m = arc_of_metre[at],
                    .speed_mps = profile_.speed_mps * random_.uniform(0.7, 1.3),
                    .offset_m = profile_.offset_stddev_m * random_.normal(),
                    .id = next_id_++,
                    .flipped = random_.chance(profile_.flipped_share),
                    .bias = {random_.normal(), random_.normal()},
                    .wander = {Wander(random_), Wander(random_)}};
    if (random_.chance(profile_.parked_per_km / wanted_per_km)) {
      vehicle.kind = Kind::parked;
      vehicle.offset_m = -kParked_m;
      vehicle.speed_mps = 0.0;
    } else if (random_.chance(profile_.wrong_way_share)) {
      vehicle.kind = Kind::wrong_way;
      vehicle.offset_m = -kWrongWay_m;
      vehicle.speed_mps = kCyclist_mps;
    }
    vehicles_.push_back(vehicle);
  }
}

void Traffic::drive(Vehicle& vehicle, double dt_s) {
  vehicle.arc_m += (vehicle.kind == Kind::wrong_way ? -dt_s : dt_s) * vehicle.speed_mps;
  if (vehicle.kind == Kind::driving) {
    begin_manoeuvre(vehicle, dt_s);
    shift(vehicle, dt_s);
  }
  while (vehicle.lane < lanes_.size() && vehicle.arc_m > lines_[vehicle.lane].length()) {
    const std::vector<std::size_t>& next = successors_[vehicle.lane];
    vehicle.arc_m -= lines_[vehicle.lane].length();
    vehicle.lane = next.empty() ? lanes_.size() : next[random_.below(next.size())];
    // Beside the next lane there need not be another one.
    vehicle.manoeuvre = vehicle.shift_m == 0.0 ? std::nullopt : std::optional(Manoeuvre{});
  }
  if (vehicle.arc_m < 0.0) vehicle.lane = lanes_.size();
}

void Traffic::begin_manoeuvre(Vehicle& vehicle, double dt_s) {
  if (vehicle.manoeuvre || lanes_[vehicle.lane].in_intersection) return;
  const bool oncoming = random_.chance(dt_s * profile_.overtakings_per_s);
  if (!oncoming && !random_.chance(dt_s * profile_.lane_changes_per_s)) return;
  const bool left = oncoming || random_.chance(0.5);
  const auto lane = lane_beside(vehicle, left, oncoming);
  if (!lane) return;
  const Point foot = lines_[*lane].project(position(vehicle)).foot;
  const double beside_m = (foot - position(vehicle)).head<2>().norm();
  vehicle.manoeuvre = Manoeuvre{.target_m = left ? beside_m : -beside_m};
  if (oncoming)
    vehicle.manoeuvre->hold_s = kOvertaking_s;
  else
    vehicle.manoeuvre->lane = lane;
}

void Traffic::shift(Vehicle& vehicle, double dt_s) {
  if (!vehicle.manoeuvre) return;
  Manoeuvre& manoeuvre = *vehicle.manoeuvre;
  const double left_m = manoeuvre.target_m - vehicle.shift_m;
  vehicle.shift_m += std::clamp(left_m, -kShift_mps * dt_s, kShift_mps * dt_s);
  if (vehicle.shift_m != manoeuvre.target_m) return;
  if (manoeuvre.lane) {
    const Projection foot = lines_[*manoeuvre.lane].project(position(vehicle));
    vehicle.lane = *manoeuvre.lane;
    vehicle.arc_m = foot.arc_m;
    vehicle.offset_m = foot.lateral_m;
    vehicle.shift_m = 0.0;
    vehicle.manoeuvre.reset();
  } else if (manoeuvre.hold_s > 0.0) {
    manoeuvre.hold_s -= dt_s;
  } else if (manoeuvre.target_m != 0.0) {
    manoeuvre.target_m = 0.0;
  } else {
    vehicle.manoeuvre.reset();
  }
}

std::optional<std::size_t> Traffic::lane_beside(const Vehicle& vehicle, bool left, bool oncoming) const {
  const Point here = position(vehicle);
  const Eigen::Vector2d along = lines_[vehicle.lane].direction(vehicle.arc_m);
  for (std::size_t i = 0; i < lanes_.size(); ++i) {
    if (lanes_[i].in_intersection) continue;
    const Projection foot = lines_[i].project(here, 5.0);
    if (!foot.inside || std::abs(foot.foot.z() - here.z()) > 1.0) continue;
    const double cosine = along.dot(lines_[i].direction(foot));
    const double left_m = cross(along, (foot.foot - here).head<2>());
    const bool beside = left ? left_m > 2.0 : left_m < -2.0;
    if (beside && (oncoming ? cosine < -0.95 : cosine > 0.95)) return i;
  }
  return std::nullopt;
}

/// Lets ghosts come, move and go.
void Traffic::haunt(const Point& ego, double dt_s) {
  for (Ghost& ghost : ghosts_) {
    ghost.position += dt_s * ghost.velocity;
    ghost.left_s -= dt_s;
  }
  std::erase_if(ghosts_, [](const Ghost& ghost) { return ghost.left_s <= 0.0; });
  if (!random_.chance(profile_.ghosts * dt_s / kGhost_s)) return;
  const double course_rad = random_.uniform(0.0, 2.0 * std::numbers::pi);
  const Point place(random_.uniform(-40.0, 40.0), random_.uniform(-40.0, 40.0), 0.0);
  ghosts_.push_back({ego + place,
                     random_.uniform(2.0, 15.0) * Point(std::cos(course_rad), std::sin(course_rad), 0.0),
                     next_id_++, 2.0 * kGhost_s * random_.uniform()});
}

Point Traffic::position(const Vehicle& vehicle) const {
  const MeasuredPolyline& line = lines_[vehicle.lane];
  return line.at(vehicle.arc_m) +
         (vehicle.offset_m + vehicle.shift_m) * to_left(line.direction(vehicle.arc_m));
}

Point Traffic::heading(const Vehicle& vehicle) const {
  const Eigen::Vector2d along = lines_[vehicle.lane].direction(vehicle.arc_m);
  const double aside_m = vehicle.manoeuvre ? vehicle.manoeuvre->target_m - vehicle.shift_m : 0.0;
  Point heading(along.x(), along.y(), 0.0);
  if (vehicle.kind == Kind::wrong_way) heading = -heading;
  if (aside_m != 0.0 && vehicle.speed_mps > 0.0)
    heading += std::copysign(kShift_mps / vehicle.speed_mps, aside_m) * to_left(along);
  return heading.normalized();
}

std::optional<TrackedObject> Traffic::track(Vehicle& vehicle, const Eigen::Isometry3d& T_body_map,
                                            double dt_s) {
  if (random_.chance(dt_s / profile_.id_period_s)) vehicle.id = next_id_++;
  for (Wander& wander : vehicle.wander) wander.step(dt_s, kMemory_s, random_);
  const double turned_rad = profile_.heading_stddev_rad * random_.normal();
  const bool missed = random_.chance(profile_.missed_share);
  TrackedObject object{.id = vehicle.id, .kind = ObjectKind::car, .existence_probability = 0.9};
  object.position = T_body_map * position(vehicle);
  const double away_m = object.position.head<2>().norm();
  if (missed || away_m > kSeen_m) return std::nullopt;
  const double stddev_m = profile_.position_stddev_m + profile_.position_stddev_per_m * away_m;
  for (int axis = 0; axis < 2; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    object.position[axis] += stddev_m * std::sqrt(0.5) * (vehicle.bias[i] + vehicle.wander[i].value());
  }
  object.heading = Eigen::AngleAxisd(turned_rad, Point::UnitZ()) * (T_body_map.linear() * heading(vehicle));
  if (vehicle.flipped) object.heading = -object.heading;
  object.speed_mps = vehicle.speed_mps;
  if (vehicle.kind != Kind::wrong_way) {
    object.length_m = 4.5;
    object.width_m = 1.8;
  }
  return object;
}

}  // namespace laneloom::simulation
