#include "simulation/motorways.hpp"

#include <string>
#include <utility>

#include "simulation/road_builder.hpp"

namespace laneloom::simulation {
namespace {

constexpr double kMainWidth_m = 3.0 * kLaneWidth_m;
constexpr double kGore_m = 60.0;
constexpr double kRampEnd_m = 60.0;

Polyline mirrored(Polyline line) {
  for (Point& point : line) point.y() = -point.y();
  return line;
}

}  // namespace

Road exit_road(double speed_mps, const Ramp& shape) {
  const double exit_at_m = 155.0;
  const Alignment way({}, {straight(300.0)});
  Section section;
  section.forward = {.lanes = 3,
                     .changes = {{.at_m = 60.0, .lanes = 4},
                                 {.at_m = exit_at_m, .lanes = 3, .taper_m = 0.0, .gore_m = kGore_m}}};
  const Alignment ramp(way.at(exit_at_m).moved(-kMainWidth_m),
                       {bend(shape.radius_m, -shape.turn_deg), straight(kRampEnd_m)});
  RoadBuilder builder("exit");
  builder.add_street(way, section);
  builder.add_street(ramp, {.forward = {}, .gore_begin_m = kGore_m});
  const Point begin = way.point(10.0, -2.5 * kLaneWidth_m);
  return std::move(builder).build({begin, shape.driven ? ramp.point(ramp.length() - 10.0, -0.5 * kLaneWidth_m)
                                                       : way.point(290.0, -2.5 * kLaneWidth_m)},
                                  speed_mps);
}

Road entry_road(double speed_mps, const Ramp& shape) {
  const double entry_at_m = 155.0;
  const Alignment way({}, {straight(300.0)});
  Section section;
  section.forward = {.lanes = 3,
                     .changes = {{.at_m = entry_at_m, .lanes = 4, .taper_m = 0.0, .gore_m = kGore_m},
                                 {.at_m = 220.0, .lanes = 3}}};
  // The ramp is laid out backwards from the place where it joins, to find its start.
  const Alignment back(way.at(entry_at_m).moved(-kMainWidth_m).turned(180.0),
                       {bend(shape.radius_m, shape.turn_deg), straight(kRampEnd_m)});
  const Alignment ramp(back.end().turned(180.0),
                       {straight(kRampEnd_m), bend(shape.radius_m, -shape.turn_deg)});
  RoadBuilder builder("entry");
  builder.add_street(way, section);
  builder.add_street(ramp, {.forward = {}, .gore_end_m = kGore_m});
  const Point end = way.point(290.0, -2.5 * kLaneWidth_m);
  return std::move(builder).build(
      {shape.driven ? ramp.point(10.0, -0.5 * kLaneWidth_m) : way.point(10.0, -2.5 * kLaneWidth_m), end},
      speed_mps);
}

Road divided_road(const DividedRoad& divided, double speed_mps) {
  const std::vector<Segment> course = divided.curved
                                          ? std::vector{straight(60.0), bend(200.0, 40.0), straight(60.0)}
                                          : std::vector{straight(250.0)};
  const Alignment way({}, course);
  Section section;
  section.forward.lanes = divided.lanes;
  if (!divided.kerbs) section.gore_begin_m = way.length();
  RoadBuilder builder("median");
  builder.add_street(way, section);
  if (divided.oncoming) {
    // Laid out backwards: the same bend turns the other way, and its radius differs by the median.
    const double inner_m = 200.0 - divided.median_m;
    const std::vector<Segment> back =
        divided.curved ? std::vector{straight(60.0), bend(inner_m, -40.0), straight(60.0)} : course;
    const Alignment other(way.end().moved(divided.median_m).turned(180.0), back);
    if (!divided.kerbs) section.gore_begin_m = other.length();
    builder.add_street(other, section);
  }
  const double left_m = -(divided.driven - 0.5) * kLaneWidth_m;
  return std::move(builder).build({way.point(10.0, left_m)}, speed_mps);
}

Road mirrored(Road road) {
  road.right_hand_traffic = !road.right_hand_traffic;
  for (RoadMarking& marking : road.markings) marking.points = mirrored(marking.points);
  for (RoadLane& lane : road.lanes) {
    for (Polyline* line : {&lane.left, &lane.right, &lane.centerline}) *line = mirrored(*line);
    std::swap(lane.left, lane.right);
    std::swap(lane.left_marking, lane.right_marking);
  }
  std::vector<VehiclePose> poses = road.drive.poses();
  for (VehiclePose& pose : poses) {
    pose.position.y() = -pose.position.y();
    pose.orientation.x() = -pose.orientation.x();
    pose.orientation.z() = -pose.orientation.z();
  }
  road.drive = Drive::recorded(std::move(poses));
  return road;
}

}  // namespace laneloom::simulation
