#include "mapping/lines/driven_over.hpp"

#include <cmath>
#include <cstddef>

#include "laneloom/polyline.hpp"
#include "mapping/geometry/levels.hpp"

namespace laneloom::lines {
namespace {

constexpr double kAlong = 0.9;     // cosine between an edge and the way
constexpr double kDenied = -20.0;  // log odds that no frame makes good

}  // namespace

void deny_driven_over(std::span<const Point> way, std::vector<Line>& lines) {
  if (way.size() < 2) return;
  const MeasuredPolyline course(Polyline(way.begin(), way.end()));
  for (Line& line : lines) {
    if (line.type() != MarkingType::roadedge) continue;
    for (std::size_t i = 0; i < line.stations.size(); ++i) {
      const Point& place = line.stations[i].position;
      const Projection foot = course.project(place, kHalfBody_m);
      if (!foot.inside || foot.distance_m >= kHalfBody_m || !geometry::may_drive_on(place, foot.foot))
        continue;
      if (std::abs(course.direction(foot).dot(direction_at(line, i))) > kAlong)
        line.stations[i].log_odds = kDenied;
    }
  }
}

}  // namespace laneloom::lines
