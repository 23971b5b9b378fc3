#include "experiment/oracle.hpp"
#include "mapping/geometry/left_of.hpp"

#include <algorithm>

namespace laneloom::experiment {
namespace {

constexpr double kSpacing_m = 1.0;
constexpr double kMinLength_m = 0.001;  // a marking that has no length has no side either
constexpr double kGate_m = 3.0;         // of a station from a detection; a ring passes a place twice

}  // namespace

Oracle::Oracle(const simulation::Road& truth) {
  for (const simulation::RoadMarking& marking : truth.markings) {
    const MeasuredPolyline measured(marking.points);
    if (measured.length() < kMinLength_m) continue;
    Line& line = lines_.emplace_back(Line{marking.id, marking.type, marking.style, {}});
    const double spacing_m = std::min(kSpacing_m, 0.5 * measured.length());
    for (double arc_m = 0.0; arc_m <= measured.length(); arc_m += spacing_m) {
      line.stations.push_back({measured.at(arc_m), geometry::left_of(measured.direction(arc_m)), 0.0, 0});
    }
  }
}

void Oracle::observe(const Polyline& points_map, Line& line) {
  const MeasuredPolyline detected(points_map);
  Eigen::AlignedBox2d box;
  for (const Point& point : points_map) box.extend(Eigen::Vector2d(point.head<2>()));
  for (Station& station : line.stations) {
    if (box.exteriorDistance(Eigen::Vector2d(station.point.head<2>())) > kGate_m) continue;
    const Projection projection = detected.project(station.point);
    if (!projection.inside || projection.distance_m > kGate_m) continue;
    station.offsets_m += (projection.foot - station.point).head<2>().dot(station.left);
    ++station.count;
  }
}

void Oracle::publish(const Line& line, LocalMap& map) {
  Polyline points;
  const auto finish = [&] {
    if (points.size() >= 2) {
      const Marking marking{.id = line.id,
                            .type = line.type,
                            .points = points,
                            .styles = {{{0.0, length(points)}, line.style}}};
      if (line.type == MarkingType::stopline) {
        map.stoplines.push_back({marking, {}, Point::Zero()});
      } else {
        map.boundaries.push_back(marking);
      }
    }
    points.clear();
  };
  for (const Station& station : line.stations) {
    if (station.count == 0) {
      finish();
      continue;
    }
    Point point = station.point;
    point.head<2>() += station.offsets_m / static_cast<double>(station.count) * station.left;
    points.push_back(point);
  }
  finish();
}

LocalMap Oracle::update(const SimulatedFrame& frame) {
  const auto& detections = frame.record.frame.detections;
  for (std::size_t i = 0; i < detections.size(); ++i) {
    const auto line = std::ranges::find(lines_, frame.sources[i], &Line::id);
    if (frame.sources[i] == kNoElement || line == lines_.end()) continue;
    Polyline points_map;
    for (const Point& point : detections[i].points) points_map.push_back(frame.T_map_body * point);
    observe(points_map, *line);
  }
  LocalMap map{.stamp_ns = frame.record.frame.stamp_ns, .T_map_body = frame.T_map_body};
  for (const Line& line : lines_) publish(line, map);
  return map;
}

}  // namespace laneloom::experiment
