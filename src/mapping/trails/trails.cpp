#include "mapping/trails/trails.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "base/seconds.hpp"
#include "mapping/trails/vehicles.hpp"

namespace laneloom::trails {
namespace {

constexpr std::size_t kMaxPoints = 64;
constexpr std::size_t kMaxTrails = 512;  // with 64 points each, 0.9 MB
constexpr double kStep_m = 1.0;
constexpr double kMaxStep_m = 5.0;

// An object is another one than before beyond these. Jumps are from the place to which its speed would have
// taken it.
constexpr double kMaxJump_m = 3.0;
constexpr double kMaxJumpOfOthers_m = 1.5;  // to the object of another tracker
constexpr double kMaxPause_s = 1.0;
constexpr double kCosMaxTurn = 0.5;  // 60 degrees

/// Whether an object that is observed now can be the one that left the trail.
bool goes_on(const Trail& trail, const Trail& observed, double max_jump_m) {
  const double step_s = seconds(observed.stamp_ns - trail.stamp_ns);
  if (step_s > kMaxPause_s || trail.heading.dot(observed.heading) < kCosMaxTurn) return false;
  const Eigen::Vector2d moved = (observed.position - trail.position).head<2>();
  return (moved - trail.speed_mps * step_s * trail.heading).norm() <= max_jump_m;
}

/// Appends the way from one observation to the next one. A fast vehicle that is seen twice a second leaves
/// more than 10 m between them.
void append_way(const Point& from, const Point& to, Polyline& points) {
  const int steps = static_cast<int>(std::ceil((to - from).head<2>().norm() / kMaxStep_m));
  for (int k = 1; k < steps; ++k) points.emplace_back(from + static_cast<double>(k) / steps * (to - from));
  points.push_back(to);
}

}  // namespace

Eigen::Vector2d direction_at(const Polyline& points, std::size_t k) {
  const Point& from = points[k == 0 ? 0 : k - 1];
  const Point& to = points[std::min(k + 2, points.size() - 1)];
  return (to - from).head<2>().normalized();
}

void Trails::add(const TrackedObjects& objects, const Eigen::Isometry3d& T_map_body) {
  std::vector<Trail> observed;
  for (const TrackedObject& object : objects.objects) {
    const bool is_followed = followed_ == Of::vehicles ? is_believed(object) : is_believed_cyclist(object);
    if (!is_followed || object.position.head<2>().norm() > kTrackerReach_m) continue;
    observed.push_back({.session = objects.session_id,
                        .object = object.id,
                        .points = {},
                        .stamp_ns = objects.stamp_ns,
                        .position = T_map_body * object.position,
                        .heading = (T_map_body.linear() * object.heading).head<2>().normalized(),
                        .speed_mps = object.speed_mps});
  }
  std::ranges::sort(observed, {}, &Trail::object);
  for (const Trail& now : observed) {
    Trail* const own = trail_of(now);
    if (own == nullptr) continue;
    Trail& trail = *own;
    const Point before = std::exchange(trail.position, now.position);
    trail.stamp_ns = now.stamp_ns;
    trail.heading = now.heading;
    trail.speed_mps = now.speed_mps;
    Polyline& points = trail.points;
    const bool far = points.empty() || (now.position - points.back()).head<2>().norm() >= kStep_m;
    if (now.speed_mps <= kMoving_mps || !far) continue;
    append_way(before, now.position, points);
    grown_ = true;
    if (points.size() > kMaxPoints)
      points.erase(points.begin(), points.end() - static_cast<std::ptrdiff_t>(kMaxPoints));
  }
  drop_excess(objects.stamp_ns);
}

/// Forgets trails above the bound: first those of vehicles that are followed no more and left no way, then
/// those that were not seen for longest.
void Trails::drop_excess(std::int64_t now_ns) {
  const auto worth = [&](const Trail& trail) {
    const bool may_tell = trail.points.size() >= 2 || seconds(now_ns - trail.stamp_ns) <= kMaxPause_s;
    return std::pair(may_tell, trail.stamp_ns);
  };
  while (trails_.size() > kMaxTrails) trails_.erase(std::ranges::min_element(trails_, {}, worth));
}

/// The trail that an observed object goes on with, or a new one. Null: another tracker follows the vehicle.
Trail* Trails::trail_of(const Trail& observed) {
  const auto newest = std::find_if(trails_.rbegin(), trails_.rend(), [&](const Trail& trail) {
    return trail.object == observed.object && trail.session == observed.session;
  });
  if (newest != trails_.rend() && goes_on(*newest, observed, kMaxJump_m)) {
    // A vehicle that moves against its heading was seen the wrong way round.
    const bool against = !newest->points.empty() && observed.speed_mps > kMoving_mps &&
                         (observed.position - newest->points.back()).head<2>().norm() >= kStep_m &&
                         (observed.position - newest->points.back()).head<2>().dot(observed.heading) <= 0.0;
    if (!against) return &*newest;
  }
  // Where it is turned round again and again, it would begin a trail each metre.
  if (newest != trails_.rend() && newest->points.size() < 2) trails_.erase(std::next(newest).base());
  const bool has_another = std::ranges::any_of(trails_, [&](const Trail& trail) {
    return trail.session != observed.session && goes_on(trail, observed, kMaxJumpOfOthers_m);
  });
  return has_another ? nullptr : &trails_.emplace_back(observed);
}

void Trails::keep_around(const Point& vehicle) {
  const auto is_near = [&](const Point& point) {
    return (point - vehicle).head<2>().squaredNorm() <= kTrackerReach_m * kTrackerReach_m;
  };
  for (Trail& trail : trails_) {
    // What lies between two near places stays, so that no trail has a hole.
    trail.points.erase(trail.points.begin(), std::ranges::find_if(trail.points, is_near));
  }
  std::int64_t newest_ns = 0;
  for (const Trail& trail : trails_) newest_ns = std::max(newest_ns, trail.stamp_ns);
  std::erase_if(trails_, [&](const Trail& trail) {
    return trail.points.empty() && seconds(newest_ns - trail.stamp_ns) > kMaxPause_s;
  });
}

}  // namespace laneloom::trails
