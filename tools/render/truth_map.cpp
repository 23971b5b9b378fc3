#include "render/truth_map.hpp"

#include "laneloom/polyline.hpp"

namespace laneloom {
namespace {

Marking drawn(const RoadMarking& marking) {
  Marking drawn;
  drawn.id = marking.id;
  drawn.type = marking.type;
  drawn.points = marking.points;
  drawn.styles = {{{0.0, length(marking.points)}, marking.style}};
  return drawn;
}

Lane drawn(const RoadLane& lane) {
  Lane drawn;
  drawn.id = lane.id;
  drawn.left = lane.left;
  drawn.right = lane.right;
  drawn.centerline = lane.centerline;
  drawn.direction = Lane::Direction::along_centerline;
  return drawn;
}

}  // namespace

LocalMap map_of(const Road& truth) {
  LocalMap map;
  for (const RoadMarking& marking : truth.markings) {
    if (marking.type == MarkingType::stopline)
      map.stoplines.push_back({drawn(marking), {}, Point::Zero()});
    else
      map.boundaries.push_back(drawn(marking));
  }
  for (const RoadLane& lane : truth.lanes) {
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

}  // namespace laneloom
