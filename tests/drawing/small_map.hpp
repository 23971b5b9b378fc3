#pragma once

#include "laneloom/types.hpp"

namespace laneloom {

/// A solid and a dashed line beside a lane, a stopline at its end, and a lane that continues it.
inline LocalMap small_map() {
  LocalMap map;
  map.stamp_ns = 10'000'000'000;
  map.boundaries.resize(2);
  Marking& left = map.boundaries[0];
  left.id = 11;
  left.points = {{0, 1.75, 0}, {5, 1.75, 0}, {10, 1.75, 0}};
  left.styles = {{{0, 4}, MarkingStyle::solid}, {{4, 10}, MarkingStyle::dashed}};
  left.lateral_stddev_m = {0.1, 0.2, 0.3};
  left.existence_probability = 0.5;
  left.observations = 7;
  left.first_seen_ns = 8'000'000'000;
  left.last_seen_ns = 9'500'000'000;
  Marking& right = map.boundaries[1];
  right.id = 12;
  right.type = MarkingType::roadedge;
  right.status = ElementStatus::tentative;
  right.points = {{0, -1.75, 0}, {10, -1.75, 0}};
  map.lanes.resize(2);
  Lane& lane = map.lanes[0];
  lane.id = 21;
  lane.left_borders = {{11, {0, 10}, {0, 10}}};
  lane.right_borders = {{12, {0, 6}, {0, 6}}, {kNoElement, {6, 10}, {}}};
  lane.use = Lane::Use::lane;
  lane.evidence = Evidence::markings | Evidence::edges;
  lane.direction_probability = 0.9;
  lane.direction_evidence = Evidence::ego_path;
  lane.left = left.points;
  lane.right = right.points;
  lane.centerline = {{0, 0, 0}, {10, 0, 0}};
  lane.width_m = 3.5;
  lane.direction = Lane::Direction::against_centerline;
  lane.left_neighbours = {{22, {0, 10}, {{4, 10}}}};
  Lane& next = map.lanes[1];
  next.id = 22;
  next.centerline = {{12, 0, 0}, {20, 0, 0}};
  Linkage& linkage = map.linkages.emplace_back();
  linkage.from = 21;
  linkage.to = 22;
  linkage.kind = Linkage::Kind::ego_track;
  linkage.turn = Linkage::Turn::left;
  Stopline& stopline = map.stoplines.emplace_back();
  stopline.marking.id = 13;
  stopline.marking.type = MarkingType::stopline;
  stopline.marking.points = {{10, -1.75, 0}, {10, 1.75, 0}};
  stopline.lanes = {21};
  stopline.heading = Point::UnitX();
  map.markings = map.boundaries;
  map.driven_paths = {
      {.id = 31, .points = {{20, 0, 0}, {24, 3, 0}}, .lateral_stddev_m = 0.6, .probability = 0.85}};
  map.way =
      Way{.stations = {{.point = {1, 0, 0}, .lane = 21, .width_m = 3.5}, {.point = {2, 0, 0}, .lane = 21}},
          .lanes = {{.id = 21}},
          .known_m = 1.5,
          .confirmed_m = 1.0};
  map.lineage = {{LineageEvent::Kind::merged_into, LineageEvent::Element::boundary, 9, 11},
                 {LineageEvent::Kind::split_from, LineageEvent::Element::lane, 22, 21}};
  return map;
}

}  // namespace laneloom
