#include "simulation/road_builder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>

#include "laneloom/polyline.hpp"
#include "simulation/borders.hpp"
#include "simulation/cross_section.hpp"
#include "simulation/route.hpp"

namespace laneloom::simulation {
namespace {

constexpr double kCoincident_m = 0.02;
constexpr double kStoplineSetback_m = 0.8;
constexpr double kStoplineMargin_m = 0.15;

double offset_m(const Mouth& mouth, int lanes) {
  return half_width_m(lanes, mouth.centre, mouth.lane_width_m);
}

int lanes_at_end(const RoadHalf& side) {
  return side.changes.empty() ? side.lanes : side.changes.back().lanes;
}

bool coincide(const Point& a, const Point& b) { return (a - b).norm() < kCoincident_m; }

bool continues(const RoadLane& from, const RoadLane& to) {
  return coincide(from.left.back(), to.left.front()) && coincide(from.right.back(), to.right.front());
}

// Whether `to` opens beside the end of `from`, or `from` closes beside the start of `to`.
bool adjoins(const RoadLane& from, const RoadLane& to) {
  const bool touches =
      coincide(from.left.back(), to.right.front()) || coincide(from.right.back(), to.left.front());
  return touches &&
         end_direction(from.centerline, End::back).dot(end_direction(to.centerline, End::front)) < -0.5;
}

void add_successors(Road& road) {
  std::set<ElementId> with_predecessor;
  for (RoadLane& from : road.lanes) {
    for (const RoadLane& to : road.lanes) {
      if (!continues(from, to)) continue;
      from.successors.push_back(to.id);
      with_predecessor.insert(to.id);
    }
  }
  std::vector<ElementId> dead_ends;
  for (const RoadLane& lane : road.lanes) {
    if (lane.successors.empty()) dead_ends.push_back(lane.id);
  }
  for (RoadLane& from : road.lanes) {
    const bool closes = std::binary_search(dead_ends.begin(), dead_ends.end(), from.id);
    for (const RoadLane& to : road.lanes) {
      if ((closes || !with_predecessor.contains(to.id)) && adjoins(from, to))
        from.successors.push_back(to.id);
    }
    std::sort(from.successors.begin(), from.successors.end());
  }
}

Polyline along(const Alignment& alignment, const Border& border, const std::vector<double>& stations_m) {
  Polyline points;
  for (const double s_m : stations_m) points.push_back(alignment.point(s_m, border.left_m.at(s_m)));
  return points;
}

Polyline route(const Road& road, const Polyline& waypoints) {
  std::vector<std::size_t> lanes{nearest_lane(road, waypoints.front())};
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    const std::size_t to = nearest_lane(road, waypoints[i]);
    const bool round = i + 1 == waypoints.size() && to == lanes.front();
    if (to == lanes.back() && !round) continue;
    const std::vector<std::size_t> way = shortest_way(road, lanes.back(), to);
    if (way.empty())
      throw std::logic_error("no way leads to waypoint " + std::to_string(i) + " of " + road.name);
    lanes.insert(lanes.end(), way.begin() + 1, way.end());
  }
  const bool round = lanes.size() > 1 && lanes.back() == lanes.front();
  if (round) lanes.pop_back();
  Polyline path = joined_centerlines(road, lanes);
  if (round) path.push_back(path.front());
  return path;
}

}  // namespace

Section two_way(int forward, int backward, CentreLine centre) {
  Section section;
  section.forward.lanes = forward;
  section.backward.lanes = backward;
  section.centre = centre;
  return section;
}

Mouth mouth_at_start(const Alignment& alignment, const Section& section) {
  return {alignment.at(0.0), section.forward.lanes, section.backward.lanes, section.centre,
          section.lane_width_m};
}

Mouth mouth_at_end(const Alignment& alignment, const Section& section) {
  return {alignment.end().turned(180.0), lanes_at_end(section.backward), lanes_at_end(section.forward),
          section.centre, section.lane_width_m};
}

ElementId RoadBuilder::add_marking(MarkingType type, MarkingStyle style, Polyline points) {
  const ElementId id = road_.markings.size() + 1;
  road_.markings.push_back({id, type, style, std::move(points)});
  return id;
}

void RoadBuilder::add_street(const Alignment& alignment, const Section& section) {
  const std::vector<Border> lines = borders(section, alignment.length());
  std::vector<ElementId> ids;
  for (const Border& line : lines) {
    Polyline points = along(alignment, line, stations(lines, line.from_m, line.to_m));
    ids.push_back(line.painted ? add_marking(line.type, line.style, std::move(points)) : kNoElement);
  }

  for (const LaneStretch& stretch : lane_stretches(lines, alignment.length())) {
    RoadLane lane{.id = road_.lanes.size() + 1,
                  .left = along(alignment, lines[stretch.left_border], stretch.stations_m),
                  .right = along(alignment, lines[stretch.right_border], stretch.stations_m),
                  .left_marking = ids[stretch.left_border],
                  .right_marking = ids[stretch.right_border]};
    if (!stretch.forward) {
      std::reverse(lane.left.begin(), lane.left.end());
      std::reverse(lane.right.begin(), lane.right.end());
      std::swap(lane.left, lane.right);
      std::swap(lane.left_marking, lane.right_marking);
    }
    lane.centerline = midway(lane.left, lane.right);
    road_.lanes.push_back(std::move(lane));
  }
}

void RoadBuilder::add_crossing(const Mouth& from, int from_lane, const Mouth& to, int to_lane) {
  const auto border = [&](int lanes) {
    const Frame begin = from.outward.moved(offset_m(from, from_lane + lanes)).turned(180.0);
    return bridge(begin, to.outward.moved(-offset_m(to, to_lane + lanes)));
  };
  RoadLane lane{.id = road_.lanes.size() + 1, .left = border(0), .right = border(1), .in_intersection = true};
  lane.centerline = midway(lane.left, lane.right);
  road_.lanes.push_back(std::move(lane));
}

void RoadBuilder::add_intersection(const std::vector<Mouth>& mouths, bool stoplines) {
  for (std::size_t i = 0; i < mouths.size(); ++i) {
    const Mouth &mouth = mouths[i], &next = mouths[(i + 1) % mouths.size()];
    const Frame begin = mouth.outward.moved(offset_m(mouth, mouth.arriving)).turned(180.0);
    add_marking(MarkingType::roadedge, MarkingStyle::solid,
                bridge(begin, next.outward.moved(-offset_m(next, next.leaving))));
    if (!stoplines || mouth.arriving == 0) continue;
    const auto stopline_end = [&](double left_m) {
      return mouth.outward.moved(left_m, kStoplineSetback_m).position;
    };
    add_marking(MarkingType::stopline, MarkingStyle::solid,
                {stopline_end(offset_m(mouth, 0) + kStoplineMargin_m),
                 stopline_end(offset_m(mouth, mouth.arriving) - kStoplineMargin_m)});
  }
  for (std::size_t a = 0; a < mouths.size(); ++a) {
    for (std::size_t b = 0; b < mouths.size(); ++b) {
      const Mouth &from = mouths[a], &to = mouths[b];
      if (a == b || from.arriving == 0 || to.leaving == 0) continue;
      const double turn_rad = std::remainder(
          to.outward.heading_rad - from.outward.heading_rad - std::numbers::pi, 2.0 * std::numbers::pi);
      if (turn_rad > 0.5)
        add_crossing(from, 0, to, 0);
      else if (turn_rad < -0.5)
        add_crossing(from, from.arriving - 1, to, to.leaving - 1);
      else
        for (int k = 0; k < std::max(from.arriving, to.leaving); ++k)
          add_crossing(from, std::min(k, from.arriving - 1), to, std::min(k, to.leaving - 1));
    }
  }
}

Road RoadBuilder::build(const Polyline& waypoints, double speed_mps) && {
  add_successors(road_);
  join_markings(road_, kCoincident_m);
  road_.drive = Drive::along(route(road_, waypoints), speed_mps);
  return std::move(road_);
}

}  // namespace laneloom::simulation
