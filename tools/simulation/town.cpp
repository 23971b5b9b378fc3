#include "simulation/town.hpp"

#include <utility>
#include <vector>

#include "simulation/road_builder.hpp"

namespace laneloom::simulation {
namespace {

constexpr double kSideStreet_m = 60.0;
constexpr double kWideBend_m = 42.0;  // radius

// The distance from an intersection's centre to its mouths.
double reach_m(int lanes, CentreLine centre) { return half_width_m(lanes, centre) + kCornerRadius_m; }

// A point in the middle of the leftmost lane, which leads round the town.
Point on_lane(const Alignment& way, double s_m, const Section& section) {
  return way.point(s_m, -half_width_m(0, section.centre) - 0.5 * kLaneWidth_m);
}

Mouth add_side_street(RoadBuilder& builder, const Frame& centre, double distance_m) {
  const Alignment way(centre.moved(0.0, distance_m), {straight(kSideStreet_m)});
  const Section section = two_way(1, 1, CentreLine::solid);
  builder.add_street(way, section);
  return mouth_at_start(way, section);
}

}  // namespace

Road town(double speed_mps) {
  RoadBuilder builder("town");
  const double near_m = reach_m(1, CentreLine::solid);         // to a street of one lane per direction
  const double wide_m = reach_m(3, CentreLine::double_solid);  // to the mouth beside a wide street

  // East, along the x axis and straight over the first crossing; the street is laid out last.
  const double east_m = 240.0;
  const Frame crossing = Frame{}.moved(0.0, east_m + near_m);
  const Section plain = two_way(1, 1, CentreLine::solid);
  const Alignment between(crossing.moved(0.0, near_m), {straight(100.0)});
  // To the left at the second crossing: north, three lanes per direction, straight over the third.
  const Frame corner = between.end().moved(0.0, wide_m);
  const Section broad = two_way(3, 3, CentreLine::double_solid);
  const Alignment north(corner.turned(90.0).moved(0.0, near_m), {straight(180.0)});
  const Frame middle = north.end().moved(0.0, near_m);
  // The lanes end one after the other; a bend of 12 m, and west over the hill.
  Section shrinking = broad;
  shrinking.forward.changes = {{.at_m = 40.0, .lanes = 2}, {.at_m = 90.0, .lanes = 1}};
  shrinking.backward.changes = {{.at_m = 50.0, .lanes = 2}, {.at_m = 100.0, .lanes = 1}};
  const double tee_x_m = -kWideBend_m;
  const Frame after_middle = middle.moved(0.0, near_m);
  const double west_m = after_middle.position.x() - 12.0 - near_m - tee_x_m;
  const Profile hill({{200.0, 0.0}, {310.0, 5.5}, {420.0, 0.0}});
  const Alignment west(after_middle, {straight(160.0), bend(12.0, 90.0), straight(west_m)}, hill);
  // To the left at the T intersection: south through an S-bend, and by the wide bend to the origin.
  const Frame tee = west.end().moved(0.0, near_m);
  const Segment right = bend(60.0, -30.0), left = bend(60.0, 30.0);
  const double s_bend_m = 4.0 * 60.0 * 0.5;  // ahead: 4 r sin 30 degrees
  const double south_m = tee.position.y() - near_m - s_bend_m - kWideBend_m;
  const Alignment south(tee.turned(90.0).moved(0.0, near_m),
                        {straight(0.5 * south_m), right, left, left, right, straight(0.5 * south_m),
                         bend(kWideBend_m, 90.0), straight(east_m)});
  // On the last part, a lane per direction opens and ends.
  Section growing = plain;
  const double origin_m = south.length() - east_m;
  growing.forward.changes = {{.at_m = origin_m + 50.0, .lanes = 2}, {.at_m = origin_m + 160.0, .lanes = 1}};
  growing.backward.changes = {{.at_m = origin_m + 70.0, .lanes = 2}, {.at_m = origin_m + 140.0, .lanes = 1}};

  builder.add_street(between, plain);
  builder.add_street(north, broad);
  builder.add_street(west, shrinking);
  builder.add_street(south, growing);
  builder.add_intersection(
      {mouth_at_start(between, plain), add_side_street(builder, crossing.turned(90.0), near_m),
       mouth_at_end(south, growing), add_side_street(builder, crossing.turned(-90.0), near_m)});
  builder.add_intersection({add_side_street(builder, corner, wide_m), mouth_at_start(north, broad),
                            mouth_at_end(between, plain),
                            add_side_street(builder, corner.turned(-90.0), near_m)});
  builder.add_intersection(
      {add_side_street(builder, middle.turned(-90.0), wide_m), mouth_at_start(west, shrinking),
       add_side_street(builder, middle.turned(90.0), wide_m), mouth_at_end(north, broad)});
  builder.add_intersection(
      {mouth_at_end(west, shrinking), add_side_street(builder, tee, near_m), mouth_at_start(south, growing)});
  const Point start = on_lane(south, 100.0, growing);
  const Polyline waypoints{start, on_lane(between, 50.0, plain), on_lane(north, 90.0, broad),
                           on_lane(west, 250.0, shrinking), start};
  return std::move(builder).build(waypoints, speed_mps);
}

}  // namespace laneloom::simulation
