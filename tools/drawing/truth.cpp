#include "drawing/truth.hpp"

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

LocalMap map_of(const simulation::Road& truth) {
  LocalMap map;
  for (const simulation::RoadMarking& marking : truth.markings) {
    if (marking.type == MarkingType::stopline)
      map.stoplines.push_back({drawn(marking), {}, Point::Zero()});
    else
      map.boundaries.push_back(drawn(marking));
  }
  for (const simulation::RoadLane& lane : truth.lanes) {
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
