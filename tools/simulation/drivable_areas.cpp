#include "simulation/drivable_areas.hpp"

#include <algorithm>
#include <cmath>

#include "laneloom/polyline.hpp"

namespace laneloom::simulation {
namespace {

constexpr double kAdjoining_m = 0.3;
constexpr double kSameHeight_m = 2.0;
constexpr double kPiece_m = 0.5;
constexpr double kMinLength_m = 1.0;

struct Area {
  MeasuredPolyline outline;  // closed
  Point low, high;           // bounding box

  bool inside_outline(const Point& p) const {
    bool inside = false;
    const Polyline& ring = outline.points();
    for (std::size_t i = 1; i < ring.size(); ++i) {
      const Point &a = ring[i - 1], &b = ring[i];
      if ((a.y() > p.y()) == (b.y() > p.y())) continue;
      if (p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y())) inside = !inside;
    }
    return inside;
  }

  bool covers(const Point& p) const {
    for (int axis = 0; axis < 2; ++axis) {
      if (p[axis] < low[axis] - kAdjoining_m || p[axis] > high[axis] + kAdjoining_m) return false;
    }
    const Projection foot = outline.project(p);
    if (std::abs(foot.foot.z() - p.z()) > kSameHeight_m) return false;
    return foot.distance_m < kAdjoining_m || inside_outline(p);
  }
};

Area make_area(Polyline ring) {
  if ((ring.front() - ring.back()).norm() > 1e-6) ring.push_back(ring.front());
  Area area{.outline = MeasuredPolyline(ring), .low = ring.front(), .high = ring.front()};
  for (const Point& p : ring) {
    area.low = area.low.cwiseMin(p);
    area.high = area.high.cwiseMax(p);
  }
  return area;
}

bool covered_by_others(const std::vector<Area>& areas, std::size_t self, const Point& p) {
  for (std::size_t i = 0; i < areas.size(); ++i) {
    if (i != self && areas[i].covers(p)) return true;
  }
  return false;
}

// The stretches of an outline, by arc length, that no other area covers.
std::vector<Stretch> free_stretches(const std::vector<Area>& areas, std::size_t self) {
  const MeasuredPolyline& outline = areas[self].outline;
  const int pieces = std::max(1, static_cast<int>(std::ceil(outline.length() / kPiece_m)));
  const double piece_m = outline.length() / pieces;
  std::vector<Stretch> stretches;
  bool free_before = false;
  for (int i = 0; i < pieces; ++i) {
    const bool free = !covered_by_others(areas, self, outline.at((i + 0.5) * piece_m));
    if (free && !free_before) stretches.push_back({i * piece_m, i * piece_m});
    if (free) stretches.back().to_m = (i + 1) * piece_m;
    free_before = free;
  }
  return stretches;
}

}  // namespace

std::vector<Polyline> outer_edges(const std::vector<Polyline>& areas) {
  std::vector<Area> closed;
  closed.reserve(areas.size());
  for (const Polyline& area : areas) closed.push_back(make_area(area));
  std::vector<Polyline> edges;
  for (std::size_t i = 0; i < closed.size(); ++i) {
    // A stretch over the ring's seam comes as two, which are joined as markings.
    for (const Stretch& stretch : free_stretches(closed, i)) {
      if (stretch.length() >= kMinLength_m) edges.push_back(closed[i].outline.slice(stretch));
    }
  }
  return edges;
}

}  // namespace laneloom::simulation
