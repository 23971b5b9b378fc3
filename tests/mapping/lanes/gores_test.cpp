#include <gtest/gtest.h>

#include "mapping/lanes/lanes.hpp"
#include "mapping/shapes.hpp"

namespace laneloom::lanes {
namespace {

using test::boundary;
using test::straight;

/// How long the lanes are between a line along x and one that is `begin_m` to the right of it at x = 0 and
/// `end_m` at x = 40.
class Gores : public ::testing::Test {
 protected:
  Gores()
      : boundaries_{boundary(1, straight({0, 0, 0}, {40, 0, 0}, 81)),
                    boundary(2, straight({0, -1, 0}, {40, -1, 0}, 81))} {
    for (boundaries::LaneBoundary& line : boundaries_)
      line.marking.styles = {{{0.0, 50.0}, MarkingStyle::solid}};
  }

  void apart(double begin_m, double end_m) {
    for (Point& point : boundaries_[1].marking.points)
      point.y() = -begin_m - (end_m - begin_m) * point.x() / 40.0;
  }

  double lanes_m(const Point& vehicle = {-20.0, 0.0, 0.0}) {
    const auto graph = road_sections(boundaries_, test::at(0), {});
    double sum_m = 0.0;
    for (const Lane& lane : generate_lanes(boundary_pairs(graph), graph.boundaries, vehicle, {}))
      sum_m += length(lane.centerline);
    return sum_m;
  }

  std::vector<boundaries::LaneBoundary> boundaries_;
};

TEST_F(Gores, BetweenSolidLinesThatMeetNoLaneIs) {
  apart(0.2, 4.2);
  EXPECT_EQ(lanes_m(), 0.0);
  apart(4.2, 0.2);
  EXPECT_EQ(lanes_m(), 0.0);
}

TEST_F(Gores, NorWhereTheirMeetingIsNotSeen) {
  apart(1.5, 4.2);
  EXPECT_EQ(lanes_m(), 0.0);
  apart(4.2, 1.5);
  EXPECT_EQ(lanes_m(), 0.0);
}

TEST_F(Gores, NorBetweenEdges) {
  apart(1.5, 4.2);
  for (boundaries::LaneBoundary& edge : boundaries_) edge.marking.type = MarkingType::roadedge;
  EXPECT_EQ(lanes_m(), 0.0);
}

TEST_F(Gores, ALaneThatWidensALittleIsNone) {
  apart(3.0, 3.8);
  EXPECT_GT(lanes_m(), 35.0);
}

TEST_F(Gores, ALaneThatBeginsToWidenIsNone) {
  for (Point& point : boundaries_[1].marking.points)
    point.y() = -3.0 - std::max(0.0, point.x() - 10.0) / 10.0;
  EXPECT_GT(lanes_m(), 20.0);
}

TEST_F(Gores, ALaneThatOpensBesideDashesIsNone) {
  apart(0.2, 4.2);
  boundaries_[0].marking.styles = {{{0.0, 40.0}, MarkingStyle::dashed}};
  EXPECT_GT(lanes_m(), 10.0);
  boundaries_[0].marking.styles = {{{0.0, 40.0}, MarkingStyle::unknown}};
  EXPECT_GT(lanes_m(), 10.0);
}

TEST_F(Gores, EndWhereALineMayBeCrossed) {
  apart(0.2, 4.2);
  boundaries_[0].marking.styles = {{{0.0, 30.0}, MarkingStyle::solid}, {{30.0, 40.0}, MarkingStyle::dashed}};
  EXPECT_GT(lanes_m(), 6.0);
  EXPECT_LT(lanes_m(), 12.0);
}

TEST_F(Gores, AreNotEnteredAcrossDashesThatEndWhereTheyBegin) {
  apart(0.2, 4.2);
  boundaries_[0].marking.styles = {{{0.0, 5.0}, MarkingStyle::dashed}, {{5.0, 40.0}, MarkingStyle::solid}};
  EXPECT_EQ(lanes_m(), 0.0);
}

TEST_F(Gores, WhatIsDrivenInIsNone) {
  apart(1.5, 4.2);
  EXPECT_GT(lanes_m({30.0, -1.8, 0.0}), 10.0);
  EXPECT_GT(lanes_m({30.0, -1.8, 1.8}), 10.0) << "the origin of the body frame is on the roof";
  EXPECT_EQ(lanes_m({30.0, -1.8, 6.0}), 0.0) << "the vehicle is on a bridge";
}

}  // namespace
}  // namespace laneloom::lanes
