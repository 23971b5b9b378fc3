#include "mapping/topology/driven_paths.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "laneloom/polyline.hpp"
#include "mapping/lanes/smooth_line.hpp"
#include "mapping/topology/line_places.hpp"

namespace laneloom::topology {
namespace {

constexpr double kBeside_m = 2.6;         // from a lane or a path, up to where a trail tells nothing new
constexpr double kCosAlong = 0.70710678;  // 45 degrees
constexpr double kMinTrail_m = 20.0;      // a shorter trail may be a ghost's
constexpr double kMinLength_m = 8.0;      // of a path
constexpr double kStep_m = 1.0;           // between its points
constexpr double kDriverStddev_m = 0.6;   // drivers keep off the middle
constexpr double kOneTrail = 0.85;        // probability of a path that one vehicle drove
constexpr double kSoundShare = 0.8;       // of the metres that a sound tracker tells, in long trails
constexpr double kMinProbability = 0.6;   // of a path that is told

/// The courses on which traffic is known to run.
class KnownCourses {
 public:
  explicit KnownCourses(const RoadGraph& road) : lanes_(road.lanes.size()) {
    std::vector<const Polyline*> lines;
    lines.reserve(road.lanes.size() + road.linkages.size());
    for (const Lane& lane : road.lanes) lines.push_back(&lane.centerline);
    for (const Linkage& linkage : road.linkages)
      if (linkage.path.size() >= 2) lines.push_back(&linkage.path);
    courses_.emplace_back(lines, kBeside_m);
  }

  /// Whether traffic is known to run past a point in a direction. Beside a lane, either direction is known.
  bool contains(const Point& point, const Eigen::Vector2d& direction) const {
    bool found = false;
    for (const LinePlaces& courses : courses_) {
      const bool is_road = &courses == &courses_.front();
      courses.beside(point, [&](const LinePlace& place, double) {
        const double along = place.direction.dot(direction);
        found = found || (is_road && place.line < lanes_ ? std::abs(along) : along) > kCosAlong;
      });
    }
    return found;
  }

  void add(const Polyline& path) { courses_.emplace_back(std::vector{&path}, kBeside_m); }

 private:
  std::size_t lanes_;
  std::vector<LinePlaces> courses_;  ///< of the road first; its lanes come before the paths of its linkages
};

/// The stretches of a trail within the box that lie on no known course. `driven` are those within lanes, in
/// the order of the trail.
std::vector<Polyline> new_stretches(const Polyline& trail, std::span<const DrivenStretch> driven,
                                    const KnownCourses& known, const geometry::MapBox& box) {
  std::vector<Polyline> stretches(1);
  const auto add = [&](std::size_t from, std::size_t to) {
    for (std::size_t k = from; k < to; ++k) {
      const bool is_new = box.shows(trail[k]) && !known.contains(trail[k], trails::direction_at(trail, k));
      const Polyline& last = stretches.back();
      const bool follows =
          is_new && !last.empty() && (trail[k] - last.back()).head<2>().norm() <= trails::kMaxGap_m;
      if (!last.empty() && !follows) stretches.emplace_back();
      if (is_new) stretches.back().push_back(trail[k]);
    }
    if (!stretches.back().empty()) stretches.emplace_back();
  };
  std::size_t from = 0;
  for (const DrivenStretch& stretch : driven) {
    add(from, stretch.first);
    from = stretch.last + 1;
  }
  add(from, trail.size());
  return stretches;
}

/// The share of all driven metres that long trails have. A tracker that loses its objects, takes one for
/// another or turns them round leaves short trails: then a long one, too, may be made of several objects.
double share_of_long(const std::vector<double>& lengths_m) {
  double long_m = 0.0, all_m = 0.0;
  for (const double length_m : lengths_m) {
    all_m += length_m;
    if (length_m >= kMinTrail_m) long_m += length_m;
  }
  return all_m > 0.0 ? long_m / all_m : 0.0;
}

/// The path along places that a tracker told, each with an error of its own.
Polyline path_along(const Polyline& places) {
  const Polyline points = resample(places, kStep_m);
  return lanes::smooth_line(points, std::vector<double>(points.size(), 1.0));
}

}  // namespace

std::vector<DrivenPath> driven_paths(const std::vector<trails::Trail>& trails,
                                     const std::vector<DrivenStretch>& driven, const RoadGraph& road,
                                     const geometry::MapBox& box) {
  std::vector<DrivenPath> paths;
  std::vector<double> lengths_m(trails.size());
  std::ranges::transform(trails, lengths_m.begin(),
                         [](const trails::Trail& trail) { return length(trail.points); });
  const double probability = kOneTrail * std::min(1.0, share_of_long(lengths_m) / kSoundShare);
  if (probability < kMinProbability) return paths;
  KnownCourses known(road);
  auto first = driven.begin();
  for (std::size_t i = 0; i < trails.size(); ++i) {
    const auto is_other = [i](const DrivenStretch& stretch) { return stretch.trail != i; };
    const auto own = std::span(first, std::find_if(first, driven.end(), is_other));
    first += std::ssize(own);
    if (lengths_m[i] < kMinTrail_m) continue;
    for (const Polyline& stretch : new_stretches(trails[i].points, own, known, box)) {
      if (stretch.size() < 2 || length(stretch) < kMinLength_m) continue;
      DrivenPath path{
          .points = path_along(stretch), .lateral_stddev_m = kDriverStddev_m, .probability = probability};
      known.add(path.points);
      paths.push_back(std::move(path));
    }
  }
  return paths;
}

}  // namespace laneloom::topology
