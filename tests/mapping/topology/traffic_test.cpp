#include "mapping/topology/traffic.hpp"

#include <gmock/gmock.h>

#include <numbers>

#include "mapping/shapes.hpp"

namespace laneloom::topology {
namespace {

using test::lane;
using test::straight;

trails::Trail trail(const Polyline& points) { return {.session = 1, .object = 1, .points = points}; }

/// Points a metre apart.
Polyline driven(const Point& from, const Point& to) { return MeasuredPolyline({from, to}).resample(1.0); }

/// "lane:metres" of each stretch, in whole metres.
std::string text(const std::vector<DrivenStretch>& stretches) {
  std::string result;
  for (const DrivenStretch& stretch : stretches)
    result += (result.empty() ? "" : " ") + std::to_string(stretch.lane) + ":" +
              std::to_string(std::lround(stretch.along_m));
  return result;
}

std::string along_x(const Polyline& points) {
  return text(driven_stretches({trail(points)}, {lane(1, straight({0, 0, 0}, {40, 0, 0}))}));
}

TEST(DrivenStretches, AreWithinALaneAndAlongIt) {
  EXPECT_EQ(along_x(driven({5, 1, 0}, {25, 1, 0})), "0:20");
  EXPECT_EQ(along_x(driven({25, 1, 0}, {5, 1, 0})), "0:-20") << "against it";
  EXPECT_EQ(along_x(driven({30, 1, 0}, {60, 1, 0})), "0:10") << "up to its end";
  EXPECT_EQ(along_x(driven({5, 1.4, 0}, {25, 1.4, 0})), "") << "beside it";
  EXPECT_EQ(along_x(driven({5, 1, 5}, {25, 1, 5})), "") << "on a bridge above it";
  EXPECT_EQ(along_x(driven({5, -10, 0}, {5, 10, 0})), "") << "across it";
  EXPECT_EQ(along_x({{5, 0, 0}}), "") << "a single place";
  EXPECT_EQ(text(driven_stretches({}, {lane(1, straight({0, 0, 0}, {40, 0, 0}))})), "");
}

TEST(DrivenStretches, ReachAsFarAsideWhateverTheLanesHeading) {
  for (int deg = 0; deg < 360; deg += 15) {
    const Eigen::AngleAxisd turn(deg * std::numbers::pi / 180.0, Point::UnitZ());
    const auto stretches = [&](double y) {
      return text(driven_stretches({trail(driven(turn * Point(5, y, 0), turn * Point(25, y, 0)))},
                                   {lane(1, straight(turn * Point(0, 0, 0), turn * Point(40, 0, 0)))}));
    };
    for (const double y : {-1.19, 0.0, 1.19}) EXPECT_EQ(stretches(y), "0:20") << deg << " degrees, " << y;
    for (const double y : {-1.21, 1.21}) EXPECT_EQ(stretches(y), "") << deg << " degrees, " << y;
  }
}

TEST(DrivenStretches, OfAChangeOfLanesAreInTheOrderInWhichTheyWereDriven) {
  const std::vector<Lane> lanes{lane(1, straight({0, 0, 0}, {40, 0, 0})),
                                lane(2, straight({40, 3.5, 0}, {0, 3.5, 0}))};
  Polyline points = driven({0, 0, 0}, {15, 0, 0});
  for (const Point& point : driven({25, 3.5, 0}, {40, 3.5, 0})) points.push_back(point);
  EXPECT_EQ(text(driven_stretches({trail(points)}, lanes)), "0:15 1:-15");
}

TEST(OneWayShares, AreTheShareOfALaneBesideOneWayStreets) {
  const std::vector<Lane> lanes{lane(1, straight({0, 0, 0}, {40, 0, 0})),
                                lane(2, straight({40, 3.5, 0}, {0, 3.5, 0}))};
  const SdMap whole({{.id = 1, .nodes = {1, 2}, .points = {{-100, 2}, {100, 2}}, .oneway = true}}, {});
  EXPECT_THAT(one_way_shares(whole, lanes), ::testing::ElementsAre(1.0, -1.0));
  const SdMap part({{.id = 1, .nodes = {1, 2}, .points = {{-100, 2}, {10, 2}}, .oneway = true}}, {});
  EXPECT_THAT(one_way_shares(part, {lanes[0]}),
              ::testing::ElementsAre(::testing::DoubleNear(2.0 / 3.0, 1e-9)))
      << "the street ends 10 m before the middle of the lane";
  EXPECT_TRUE(one_way_shares(SdMap(), lanes).empty());
}

/// Two lanes that run along x, with a boundary 2 between them; the vehicle drives in lane 12, on the right.
class Side : public ::testing::Test {
 protected:
  Side() {
    for (const ElementId id : {1U, 2U, 3U}) {
      const double y = 7.0 - 3.5 * static_cast<double>(id - 1);
      boundaries_.push_back(test::boundary(id, straight({0, y, 0}, {40, y, 0})));
    }
    for (const ElementId left : {1U, 2U}) {
      const double y = 7.0 - 3.5 * static_cast<double>(left - 1);
      lanes_.push_back({.id = 10 + left,
                        .left_borders = {{left, {0.0, 40.0}, {0.0, 40.0}}},
                        .right_borders = {{left + 1, {0.0, 40.0}, {0.0, 40.0}}},
                        .left = straight({0, y, 0}, {40, y, 0}),
                        .right = straight({0, y - 3.5, 0}, {40, y - 3.5, 0}),
                        .centerline = straight({0, y - 1.75, 0}, {40, y - 1.75, 0})});
    }
    lanes_[0].right_neighbours = {{.lane = 12, .range = {0.0, 40.0}}};
    lanes_[1].left_neighbours = {{.lane = 11, .range = {0.0, 40.0}}};
  }

  /// So many vehicles come towards the vehicle, and all trails are asked twice.
  void meet(int vehicles) {
    for (int i = 0; i < vehicles; ++i) trails_.push_back(trail(driven({35, 5.25, 0}, {10, 5.25, 0})));
    const RoadTraffic traffic{side_by_side({boundaries_, lanes_}), driven_stretches(trails_, lanes_)};
    for (int time = 0; time < 2; ++time) side_.observe(lanes_, traffic, tracks_, trails_);
  }

  std::vector<boundaries::LaneBoundary> boundaries_;
  std::vector<Lane> lanes_;
  lanes::LaneTracks tracks_{{{.id = 11}, {.id = 12, .direction_log_odds = 4.0}}};
  std::vector<trails::Trail> trails_;
  ObservedSide side_;
};

TEST_F(Side, TrafficThatMeetsOnTheLeftContradictsNoRightHandTraffic) {
  meet(3);
  EXPECT_FALSE(side_.contradicts(DrivingSide::right));
  EXPECT_TRUE(side_.contradicts(DrivingSide::left));
  EXPECT_FALSE(side_.contradicts(DrivingSide::unknown));
}

TEST_F(Side, OneVehicleContradictsNothing) {
  meet(1);
  EXPECT_FALSE(side_.contradicts(DrivingSide::left));
  meet(1);
  EXPECT_TRUE(side_.contradicts(DrivingSide::left));
}

TEST_F(Side, TheVehicleOnTheLeftLaneTellsTheOtherSide) {
  tracks_ = lanes::LaneTracks({{.id = 11, .direction_log_odds = -4.0}, {.id = 12}});
  for (int i = 0; i < 3; ++i) trails_.push_back(trail(driven({5, 1.75, 0}, {30, 1.75, 0})));
  meet(0);
  EXPECT_TRUE(side_.contradicts(DrivingSide::left));
  side_ = {};
  trails_.clear();
  tracks_ = lanes::LaneTracks({{.id = 11, .direction_log_odds = 4.0}, {.id = 12}});
  for (int i = 0; i < 3; ++i) trails_.push_back(trail(driven({30, 1.75, 0}, {5, 1.75, 0})));
  meet(0);
  EXPECT_TRUE(side_.contradicts(DrivingSide::right)) << "oncoming traffic is on the right";
  EXPECT_FALSE(side_.contradicts(DrivingSide::left));
}

TEST_F(Side, TrafficInTheSameDirectionTellsNothing) {
  for (int i = 0; i < 4; ++i) trails_.push_back(trail(driven({10, 5.25, 0}, {35, 5.25, 0})));
  meet(0);
  EXPECT_FALSE(side_.contradicts(DrivingSide::right));
  EXPECT_FALSE(side_.contradicts(DrivingSide::left));
}

TEST_F(Side, ACountrysBorderIsNoticed) {
  meet(20);
  tracks_ = lanes::LaneTracks({{.id = 11, .direction_log_odds = 4.0}, {.id = 12}});
  trails_.clear();
  for (int i = 0; i < 7; ++i) trails_.push_back(trail(driven({30, 1.75, 0}, {5, 1.75, 0})));
  meet(0);
  EXPECT_TRUE(side_.contradicts(DrivingSide::right));
}

/// The vehicle drives along x in a lane, a metre from frame to frame, and meets others there.
class Passing : public ::testing::Test {
 protected:
  /// The way that a vehicle drove which passes the own one at so many metres on its left.
  static trails::Trail straight_past(double left_m, double z = 0.0) {
    trails::Trail one = trail(driven({30, left_m, z}, {1, left_m, z}));
    one.position = one.points.back();
    one.heading = {-1, 0};
    return one;
  }
  void meet(int vehicles, double left_m) { meet(vehicles, straight_past(left_m)); }
  void meet(int vehicles, const trails::Trail& one) {
    std::vector<trails::Trail> trails(static_cast<std::size_t>(vehicles), one);
    Point before = own_.front().translation();
    for (const Eigen::Isometry3d& pose : own_) {
      side_.observe_passing(before, pose, layout_, trails);
      before = pose.translation();
    }
  }
  /// The poses on the way to x = 1 and back, far from where others pass.
  static std::vector<Eigen::Isometry3d> straight_on() {
    std::vector<Eigen::Isometry3d> poses;
    for (double x = -20.0; x <= 1.0; x += 1.0) poses.push_back(test::at(x));
    poses.push_back(test::at(-100.0));
    return poses;
  }
  DrivingSide told_for(DrivingSide configured) const { return side_.corrected(configured); }

  std::vector<Eigen::Isometry3d> own_ = straight_on();
  lanes::LaneLayout layout_{{}, {own_lane()}};
  ObservedSide side_;

 private:
  static Lane own_lane() {
    Lane own = lane(1, straight({-30, 0, 0}, {40, 0, 0}));
    own.left = straight({-30, 1.75, 0}, {40, 1.75, 0});
    own.right = straight({-30, -1.75, 0}, {40, -1.75, 0});
    return own;
  }
};

TEST_F(Passing, OnTheRightTellsLeftHandTraffic) {
  meet(1, -3.5);
  EXPECT_EQ(told_for(DrivingSide::right), DrivingSide::right) << "a vehicle tells it once";
  meet(1, -6.0);
  EXPECT_EQ(told_for(DrivingSide::right), DrivingSide::left);
  EXPECT_EQ(told_for(DrivingSide::left), DrivingSide::left);
  EXPECT_EQ(told_for(DrivingSide::unknown), DrivingSide::unknown);
}

TEST_F(Passing, OnTheLeftTellsRightHandTraffic) {
  meet(3, 3.5);
  EXPECT_EQ(told_for(DrivingSide::left), DrivingSide::right);
  EXPECT_EQ(told_for(DrivingSide::right), DrivingSide::right);
}

TEST_F(Passing, WhatIsBelievedStaysUntilAsManyTellTheContrary) {
  meet(3, -3.5);
  for (int i = 0; i < 5; ++i) {
    meet(1, 3.5);
    meet(1, -3.5);
    EXPECT_EQ(told_for(DrivingSide::right), DrivingSide::left) << i;
  }
  meet(3, 3.5);
  EXPECT_EQ(told_for(DrivingSide::right), DrivingSide::right);
  EXPECT_EQ(told_for(DrivingSide::left), DrivingSide::left) << "nor is the contrary believed yet";
}

/// A service road, beyond the kerb.
TEST_F(Passing, BeyondAnEdgeThatWasSeenTellsNothing) {
  layout_.boundaries =
      std::vector{test::boundary(1, test::straight({-20, -1.8, 0}, {40, -1.8, 0}), MarkingType::roadedge)};
  meet(4, -6.0);
  EXPECT_EQ(told_for(DrivingSide::right), DrivingSide::right);
  meet(3, 3.5);
  EXPECT_EQ(told_for(DrivingSide::left), DrivingSide::right);
}

TEST_F(Passing, IsNotFarAsideNorOnABridgeNorTheSameWay) {
  meet(4, -10.5);
  meet(4, -1.0);
  meet(4, straight_past(-3.5, 6.0));
  trails::Trail same_way = straight_past(-3.5);
  std::ranges::reverse(same_way.points);
  same_way.position = same_way.points.back();
  same_way.heading = {1, 0};
  meet(4, same_way);
  EXPECT_EQ(told_for(DrivingSide::right), DrivingSide::right);
}

TEST_F(Passing, OfAVehicleThatTurnsTellsNothing) {
  trails::Trail turning = straight_past(-3.5);
  turning.heading = Eigen::Vector2d(-1, 1).normalized();
  meet(4, turning);
  trails::Trail turned = trail(driven({10, -12, 0}, {10, -3.5, 0}));
  for (const Point& point : driven({9, -3.5, 0}, {1, -3.5, 0})) turned.points.push_back(point);
  turned.position = turned.points.back();
  turned.heading = {-1, 0};
  meet(4, turned);
  EXPECT_EQ(told_for(DrivingSide::right), DrivingSide::right);
}

TEST_F(Passing, OfAVehicleThatStandsTellsNothing) {
  trails::Trail standing = straight_past(-3.5);
  standing.points.clear();  // only what moves leaves points
  meet(4, standing);
  EXPECT_EQ(told_for(DrivingSide::right), DrivingSide::right);
}

TEST_F(Passing, TellsNothingWhileTheVehicleTurnsStandsOrIsInNoLane) {
  const std::vector<Eigen::Isometry3d> straight = own_;
  for (std::size_t i = 0; i < own_.size(); ++i)
    own_[i] = test::at(straight[i].translation().x(), 0.0, 0.02 * static_cast<double>(i) - 0.42);
  meet(4, -3.5);
  own_.assign(20, test::at(1.0));
  meet(4, -3.5);
  own_ = straight;
  layout_.lanes.clear();
  meet(4, -3.5);
  EXPECT_EQ(told_for(DrivingSide::right), DrivingSide::right);
}

}  // namespace
}  // namespace laneloom::topology
