#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "mapping/shapes.hpp"
#include "mapping/topology/directions.hpp"

namespace laneloom::topology {

/// Lanes of 3.5 m between y = 0 and y = 7, from x = 0 to 40, given from left to right; boundaries 1, 2, 3.
class Directions : public ::testing::Test {
 protected:
  Directions() {
    for (const ElementId id : {1U, 2U, 3U}) {
      const double y = 7.0 - 3.5 * static_cast<double>(id - 1);
      boundaries_.push_back(test::boundary(id, test::straight({0, y, 0}, {40, y, 0})));
    }
    boundaries_[0].marking.type = boundaries_[2].marking.type = MarkingType::roadedge;
    lanes_ = {lane(11, 1, 0, 40), lane(12, 2, 0, 40)};
    lanes_[0].right_neighbours = {{.lane = 12, .range = {0.0, 20.0}}};
    lanes_[1].left_neighbours = {{.lane = 11, .range = {0.0, 20.0}}};
  }

  static Lane lane(ElementId id, ElementId left, double from_x, double to_x) {
    const double y = 7.0 - 3.5 * static_cast<double>(left - 1);
    Lane lane{.id = id,
              .left_borders = {{left, {0.0, to_x - from_x}, {from_x, to_x}}},
              .right_borders = {{left + 1, {0.0, to_x - from_x}, {from_x, to_x}}},
              .left = test::straight({from_x, y, 0}, {to_x, y, 0}),
              .right = test::straight({from_x, y - 3.5, 0}, {to_x, y - 3.5, 0}),
              .centerline = test::straight({from_x, y - 1.75, 0}, {to_x, y - 1.75, 0}),
              .width_m = 3.5};
    return lane;
  }

  void divider(MarkingStyle style) { boundaries_[1].marking.styles = {{{0, 40}, style}}; }

  /// One more line beside the divider, so that the lanes share none.
  void double_divider() {
    boundaries_.push_back(test::boundary(4, test::straight({0, 3.1, 0}, {40, 3.1, 0})));
    lanes_[0].right_neighbours.clear();
    lanes_[1].left_neighbours.clear();
    lanes_[1].left_borders.front().boundary = 4;
    lanes_[1].left = test::straight({0, 3.1, 0}, {40, 3.1, 0});
  }

  /// Lane 11 is as far to the left of lane 12, behind a solid line of its own.
  void median(double width_m) {
    double_divider();
    divider(MarkingStyle::solid);
    boundaries_[3].marking.styles = {{{0, 40}, MarkingStyle::solid}};
    lanes_[1].left = test::straight({0, 3.5, 0}, {40, 3.5, 0});
    lanes_[0] = lane(11, 1, 0, 40);
    for (Polyline* line : {&lanes_[0].left, &lanes_[0].right, &lanes_[0].centerline})
      for (Point& point : *line) point.y() += width_m;
    lanes_[1] = lane(12, 2, 0, 40);
    lanes_[1].left_borders.front().boundary = 4;
    tracks_ = {};
  }

  void observe(const Eigen::Isometry3d& T_map_body, const std::vector<Marking>& markings = {}) {
    std::vector<lanes::LaneTrack> known = tracks_.all();
    for (const Lane& lane : lanes_)
      if (tracks_.find(lane.id) == nullptr) known.push_back({.id = lane.id});
    tracks_ = lanes::LaneTracks(std::move(known));
    observe_drive(lanes_, T_map_body, tracks_);
    observe_stoplines(lanes_, markings, {}, tracks_);
  }

  void find(DrivingSide driving_side = DrivingSide::right) {
    RoadGraph road{{boundaries_, lanes_}, linkages_};
    find_directions({.driving_side = driving_side}, {side_by_side(road), driven_, one_way_}, tracks_, road);
    lanes_ = std::move(road.lanes);
    linkages_ = std::move(road.linkages);
  }

  const Lane& get(ElementId id) const { return *std::ranges::find(lanes_, id, &Lane::id); }
  bool runs_forward(ElementId id) const {
    return get(id).centerline.back().x() > get(id).centerline.front().x();
  }
  bool known(ElementId id) const { return get(id).direction == Lane::Direction::along_centerline; }

  std::vector<boundaries::LaneBoundary> boundaries_;
  std::vector<Lane> lanes_;
  std::vector<Linkage> linkages_;
  std::vector<DrivenStretch> driven_;
  std::vector<double> one_way_;
  lanes::LaneTracks tracks_;
};

}  // namespace laneloom::topology
