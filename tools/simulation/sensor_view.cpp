#include "simulation/sensor_view.hpp"

#include <algorithm>
#include <utility>

#include "mapping/geometry/clip_segment.hpp"

namespace laneloom::simulation {
namespace {

constexpr double kMinPiece_m = 1.0;

}  // namespace

Polyline SensorView::polygon() const {
  return {{forward_min_m, -side_max_m, 0.0},
          {forward_max_m, -side_max_m, 0.0},
          {forward_max_m, side_max_m, 0.0},
          {forward_min_m, side_max_m, 0.0}};
}

bool SensorView::detects(MarkingType type) const {
  return detected_types.empty() ||
         std::find(detected_types.begin(), detected_types.end(), type) != detected_types.end();
}

Eigen::AlignedBox3d SensorView::box() const {
  return {Point(forward_min_m, -side_max_m, -height_max_m), Point(forward_max_m, side_max_m, height_max_m)};
}

ViewedLine::ViewedLine(const Polyline& points)
    : line(points), ring(points.size() > 3 && (points.front() - points.back()).norm() < 1e-6) {
  Point low = points.front(), high = points.front();
  for (const Point& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  centre = 0.5 * (low + high);
  radius_m = 0.5 * (high - low).norm();
}

bool ViewedLine::may_be_near(const Point& position, double distance_m) const {
  return (position - centre).norm() <= radius_m + distance_m;
}

std::vector<VisiblePiece> visible_pieces(const ViewedLine& viewed, const SensorView& view,
                                         const Eigen::Isometry3d& T_body_map) {
  std::vector<VisiblePiece> pieces;
  const Polyline& points = viewed.line.points();
  const Eigen::AlignedBox3d box = view.box();
  double arc_m = 0.0;
  bool open = false;  // the last piece goes on
  Point to = T_body_map * points.front();
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point from = std::exchange(to, T_body_map * points[i]);
    const double segment_m = (points[i] - points[i - 1]).head<2>().norm();
    if (const auto inside = geometry::clip_segment(from, to, box)) {
      const auto [enter, leave] = *inside;
      if (!open || enter > 0.0)
        pieces.push_back({{arc_m + enter * segment_m, 0.0}, {from + enter * (to - from)}});
      pieces.back().points.push_back(leave < 1.0 ? from + leave * (to - from) : to);
      pieces.back().arc.to_m = arc_m + leave * segment_m;
      open = leave == 1.0;
    } else {
      open = false;
    }
    arc_m += segment_m;
  }
  if (viewed.ring && open && pieces.size() > 1 && pieces.front().arc.from_m == 0.0) {
    VisiblePiece last = std::move(pieces.back());
    pieces.pop_back();
    VisiblePiece& first = pieces.front();
    first.arc.from_m = last.arc.from_m - arc_m;
    last.points.insert(last.points.end(), first.points.begin() + 1, first.points.end());
    first.points = std::move(last.points);
  }
  std::erase_if(pieces, [](const VisiblePiece& piece) { return length(piece.points) < kMinPiece_m; });
  return pieces;
}

}  // namespace laneloom::simulation
