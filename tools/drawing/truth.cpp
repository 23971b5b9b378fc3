#include "drawing/truth.hpp"

#include <algorithm>

#include "drawing/marking_shapes.hpp"
#include "io/json_fields.hpp"
#include "laneloom/polyline.hpp"

namespace laneloom::drawing {
namespace {

Marking drawn(const simulation::RoadMarking& marking) {
  Marking drawn;
  drawn.id = marking.id;
  drawn.type = marking.type;
  drawn.points = marking.points;
  drawn.styles = {{{0.0, length(marking.points)}, marking.style}};
  return drawn;
}

Lane drawn(const simulation::RoadLane& lane) {
  Lane drawn;
  drawn.id = lane.id;
  drawn.left = lane.left;
  drawn.right = lane.right;
  drawn.centerline = lane.centerline;
  const MeasuredPolyline left(lane.left), right(lane.right);
  drawn.width_m = (left.at(0.5 * left.length()) - right.at(0.5 * right.length())).head<2>().norm();
  drawn.direction = Lane::Direction::along_centerline;
  return drawn;
}

}  // namespace

void add_truth(const simulation::Road& truth, Drawing& drawing) {
  for (const simulation::RoadMarking& marking : truth.markings) {
    if (!drawable(marking.points)) continue;
    drawing.add({.layer = Layer::truth,
                 .key = key_of(Layer::truth, marking.id),
                 .id = marking.id,
                 .type = name(marking.type),
                 .status = {},
                 .properties = {{"style", name(marking.style)}},
                 .shapes = {{DrawnLine{marking.points}, Style::truth}}});
  }
}

LocalMap map_of(const simulation::Road& truth, const Eigen::Isometry3d& T_map_body, double reach_m) {
  LocalMap map{.T_map_body = T_map_body};
  const auto is_near = [&](const Polyline& line) {
    return std::ranges::any_of(
        line, [&](const Point& point) { return (point - T_map_body.translation()).norm() <= reach_m; });
  };
  for (const simulation::RoadMarking& marking : truth.markings) {
    if (!is_near(marking.points)) continue;
    if (marking.type == MarkingType::stopline)
      map.stoplines.push_back({drawn(marking), {}, Point::Zero()});
    else
      map.boundaries.push_back(drawn(marking));
  }
  for (const simulation::RoadLane& lane : truth.lanes) {
    if (!is_near(lane.centerline)) continue;
    map.lanes.push_back(drawn(lane));
    for (const ElementId next : lane.successors) {
      Linkage linkage;
      linkage.from = lane.id;
      linkage.to = next;
      map.linkages.push_back(linkage);
    }
  }
  return map;
}

}  // namespace laneloom::drawing
