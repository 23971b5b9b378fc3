#include "simulation/occlusion.hpp"

#include <algorithm>

#include "laneloom/polyline.hpp"

namespace laneloom::simulation {
namespace {

constexpr double kShadow_m = 100.0;  // beyond every sensor's range
constexpr double kNear_m = 4.0;      // no vehicle comes closer ahead or behind
constexpr double kBeside_m = 1.5;    // no vehicle comes closer beside
constexpr double kSplitStep_m = 0.25;

double turn(const Point& a, const Point& b, const Point& c) {
  return cross((b - a).head<2>(), (c - a).head<2>());
}

// Counter-clockwise, by Andrew's monotone chain.
Polyline convex_hull(Polyline points) {
  std::sort(points.begin(), points.end(),
            [](const Point& a, const Point& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); });
  Polyline hull;
  for (int half = 0; half < 2; ++half) {
    const std::size_t start = hull.size();
    for (const Point& p : points) {
      while (hull.size() >= start + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= 0.0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

bool contains(const Polyline& convex, const Point& p) {
  for (std::size_t i = 0; i < convex.size(); ++i) {
    if (turn(convex[i], convex[(i + 1) % convex.size()], p) < 0.0) return false;
  }
  return true;
}

}  // namespace

void Occluders::step(double dt_s, const NoiseProfile& noise, Random& random) {
  if (random.chance(noise.occluder_rate_hz * dt_s)) {
    const bool truck = random.chance(0.15);
    const double side_m = random.uniform(-1.0, 1.0) < 0.0 ? -1.0 : 1.0;
    vehicles_.push_back({.centre = {random.uniform(8.0, 35.0), side_m * random.uniform(0.0, 8.0), 0.0},
                         .speed_mps = random.uniform(-4.0, 4.0),
                         .length_m = truck ? 10.0 : 4.6,
                         .width_m = truck ? 2.5 : 1.9});
  }
  areas_.clear();
  std::vector<Vehicle> staying;
  for (Vehicle& vehicle : vehicles_) {
    vehicle.centre.x() += vehicle.speed_mps * dt_s;
    const bool leaves = random.chance(dt_s / noise.occluder_dwell_s);
    const bool too_near = std::abs(vehicle.centre.x()) < kNear_m + 0.5 * vehicle.length_m &&
                          std::abs(vehicle.centre.y()) < kBeside_m + 0.5 * vehicle.width_m;
    if (leaves || too_near) continue;
    staying.push_back(vehicle);
    areas_.push_back(hidden_area(vehicle));
  }
  vehicles_ = std::move(staying);
}

Polyline Occluders::hidden_area(const Vehicle& vehicle) {
  Polyline points;
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) {
      const Point corner = vehicle.centre + Point(x * vehicle.length_m, y * vehicle.width_m, 0.0);
      points.push_back(corner);
      points.push_back(corner * (kShadow_m / std::max(0.1, corner.norm())));
    }
  }
  return convex_hull(std::move(points));
}

std::vector<VisiblePiece> Occluders::visible_parts(const VisiblePiece& piece) const {
  if (areas_.empty()) return {piece};
  const Polyline points = MeasuredPolyline(piece.points).resample(kSplitStep_m);
  const double step_m = (piece.arc.to_m - piece.arc.from_m) / static_cast<double>(points.size() - 1);
  std::vector<VisiblePiece> parts;
  bool open = false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double arc_m = piece.arc.from_m + static_cast<double>(i) * step_m;
    const bool hidden = std::any_of(areas_.begin(), areas_.end(),
                                    [&](const Polyline& area) { return contains(area, points[i]); });
    if (!hidden && !open) parts.push_back({{arc_m, arc_m}, {}});
    if (!hidden) {
      parts.back().points.push_back(points[i]);
      parts.back().arc.to_m = arc_m;
    }
    open = !hidden;
  }
  return parts;
}

}  // namespace laneloom::simulation
