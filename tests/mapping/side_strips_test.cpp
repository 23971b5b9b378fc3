#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "laneloom/lane_graph.hpp"
#include "laneloom/reasons.hpp"
#include "mapping/asking.hpp"
#include "mapping/mapped_road.hpp"

namespace laneloom {
namespace {

using test::Drive;
using testing::IsEmpty;
using testing::SizeIs;

MapperConfig with_strips() {
  MapperConfig config;
  config.lane.publish_side_strips = true;
  return config;
}

/// Two lanes of 3.6 m, and a strip between the right one and an edge. The vehicle drives in the right one.
struct Strip {
  double width_m = 2.2;
  MarkingStyle line = MarkingStyle::solid;  ///< between the lane and the strip

  std::vector<Detection> road() const {
    const auto at_y = [](MarkingType type, double y, MarkingStyle style) {
      return test::detection(type, test::straight({-50, y, 0}, {300, y, 0}), style);
    };
    return {at_y(MarkingType::roadedge, 5.4, MarkingStyle::unknown),
            at_y(MarkingType::laneline, 1.8, MarkingStyle::dashed), at_y(MarkingType::laneline, -1.8, line),
            at_y(MarkingType::roadedge, -1.8 - width_m, MarkingStyle::unknown)};
  }
};

const LocalMap& drive_on(Drive& drive, const Strip& strip, int frames = 30) {
  for (int i = 0; i < frames; ++i) drive.step(strip.road());
  return drive.mapper.map();
}

std::vector<Lane> of_use(const LocalMap& map, Lane::Use use) {
  std::vector<Lane> lanes;
  std::ranges::copy_if(map.lanes, std::back_inserter(lanes), [&](const Lane& one) { return one.use == use; });
  return lanes;
}

std::vector<Lane> shoulders_beside(const Strip& strip) {
  Drive drive(with_strips());
  return of_use(drive_on(drive, strip), Lane::Use::shoulder);
}

TEST(SideStrips, AreShouldersBetweenASolidLineAndAnEdge) {
  for (double width_m = 1.0; width_m < 2.7; width_m += 0.2) {
    SCOPED_TRACE(width_m);
    Drive drive(with_strips());
    const LocalMap& map = drive_on(drive, {.width_m = width_m});
    const std::vector<Lane> shoulders = of_use(map, Lane::Use::shoulder);
    ASSERT_THAT(shoulders, SizeIs(1));
    const Lane& shoulder = shoulders.front();
    EXPECT_NEAR(shoulder.width_m, width_m, 0.05);
    EXPECT_NEAR(shoulder.centerline.front().y(), -1.8 - 0.5 * width_m, 0.05);
    EXPECT_GT(length(shoulder.centerline), 30.0);
    EXPECT_GT(shoulder.use_probability, 0.9);
    EXPECT_GT(shoulder.existence_probability, 0.5);
    EXPECT_EQ(shoulder.direction, Lane::Direction::unknown);
    const auto own = LaneGraph(map).own_lane(map.T_map_body);
    ASSERT_TRUE(own);
    EXPECT_EQ(own->lane.lane->right_borders.front().boundary, shoulder.left_borders.front().boundary);
  }
}

TEST(SideStrips, AreNoneBesideADashedLineOrOneWhoseStyleIsNotKnown) {
  EXPECT_THAT(shoulders_beside({.line = MarkingStyle::dashed}), IsEmpty());
  EXPECT_THAT(shoulders_beside({.width_m = 2.6, .line = MarkingStyle::unknown}), IsEmpty());
}

TEST(SideStrips, AreNoneWhereThereIsRoomForALane) {
  EXPECT_THAT(shoulders_beside({.width_m = 3.4}), IsEmpty());
  EXPECT_THAT(shoulders_beside({.width_m = 0.4}), IsEmpty());
}

TEST(SideStrips, AreNotInTheMapUnlessTheConfigurationSaysSo) {
  Drive drive;
  EXPECT_THAT(of_use(drive_on(drive, {}), Lane::Use::shoulder), IsEmpty());
}

class SideStripsBesideLanes : public testing::TestWithParam<Strip> {};

TEST_P(SideStripsBesideLanes, LeaveLanesAndTheWayAsTheyAre) {
  Drive with(with_strips()), without;
  const LocalMap &both = drive_on(with, GetParam()), &lanes = drive_on(without, GetParam());
  EXPECT_EQ(both.lanes.size(), lanes.lanes.size() + 1);
  const std::vector<Lane> published = of_use(both, Lane::Use::lane);
  ASSERT_EQ(published.size(), lanes.lanes.size());
  for (std::size_t i = 0; i < published.size(); ++i) {
    EXPECT_EQ(published[i].centerline, lanes.lanes[i].centerline);
    EXPECT_EQ(published[i].right_neighbours.size(), lanes.lanes[i].right_neighbours.size());
  }
  EXPECT_EQ(both.linkages.size(), lanes.linkages.size());
  ASSERT_TRUE(both.way && lanes.way);
  EXPECT_EQ(both.way->stations.back().point, lanes.way->stations.back().point);
}

INSTANTIATE_TEST_SUITE_P(Kinds, SideStripsBesideLanes,
                         testing::Values(Strip{}, Strip{.width_m = 1.6, .line = MarkingStyle::dashed}));

TEST(SideStrips, KeepTheirIds) {
  Drive drive(with_strips());
  const ElementId id = of_use(drive_on(drive, {}), Lane::Use::shoulder).front().id;
  for (int i = 0; i < 50; ++i) {
    const std::vector<Lane> shoulders = of_use(drive_on(drive, {}, 1), Lane::Use::shoulder);
    ASSERT_THAT(shoulders, SizeIs(1));
    EXPECT_EQ(shoulders.front().id, id);
  }
}

TEST(SideStrips, HaveReasons) {
  Asking observer;
  Drive drive(with_strips());
  for (int i = 0; i < 10; ++i) drive.step(Strip{}.road(), &observer);
  const Lane shoulder = of_use(drive.mapper.map(), Lane::Use::shoulder).front();
  const auto reason = std::ranges::find(observer.now.lanes, shoulder.id, &LaneReason::id);
  ASSERT_NE(reason, observer.now.lanes.end());
  EXPECT_EQ(reason->verdict, LaneReason::Verdict::shown);
  EXPECT_EQ(observer.now.lanes.size(), 3U) << "with the two lanes";
}

TEST(SideStrips, GiveWayToALane) {
  Drive drive(with_strips());
  ASSERT_THAT(of_use(drive_on(drive, {}), Lane::Use::shoulder), SizeIs(1));
  // The strip widens, and its line is dashed from now on: a lane begins.
  const Strip lane{.width_m = 3.4, .line = MarkingStyle::dashed};
  for (int i = 0; i < 80; ++i) {
    const LocalMap& map = drive_on(drive, lane, 1);
    for (const Lane& shoulder : of_use(map, Lane::Use::shoulder))
      for (const Lane& other : of_use(map, Lane::Use::lane)) {
        const MeasuredPolyline line(other.centerline);
        for (const Point& point : shoulder.centerline) {
          const Projection foot = line.project(point);
          EXPECT_FALSE(foot.inside && foot.distance_m < 0.4 * other.width_m) << "frame " << i;
        }
      }
  }
  EXPECT_THAT(of_use(drive.mapper.map(), Lane::Use::lane), SizeIs(3));
  EXPECT_THAT(of_use(drive.mapper.map(), Lane::Use::shoulder), IsEmpty());
}

TEST(SideStrips, AreSavedWithTheMap) {
  Drive drive(with_strips());
  drive_on(drive, {});
  Drive resumed(with_strips());
  resumed.mapper.load(drive.mapper.save());
  resumed.x = drive.x;
  resumed.number = drive.number;
  drive_on(drive, {}, 1);
  drive_on(resumed, {}, 1);
  EXPECT_EQ(drive.mapper.save(), resumed.mapper.save());
}

TEST(SideStrips, GoAlongWithPosesThatJump) {
  Drive drive(with_strips());
  const ElementId id = of_use(drive_on(drive, {}), Lane::Use::shoulder).front().id;
  const Eigen::Isometry3d jump(Eigen::Translation3d(0.0, 1.5, 0.0));
  for (int i = 0; i < 20; ++i) {
    drive.x += test::kStep_m;
    DetectionFrame frame = test::frame_at(drive.x, Strip{}.road(), ++drive.number);
    drive.mapper.update(frame, jump * test::at(drive.x));
  }
  const std::vector<Lane> shoulders = of_use(drive.mapper.map(), Lane::Use::shoulder);
  ASSERT_THAT(shoulders, SizeIs(1));
  EXPECT_EQ(shoulders.front().id, id);
  EXPECT_NEAR(shoulders.front().centerline.back().y(), 1.5 - 1.8 - 1.1, 0.1);
}

std::vector<Detection> with(std::vector<Detection> road, MarkingType type, double y, MarkingStyle style) {
  road.push_back(test::detection(type, test::straight({-50, y, 0}, {300, y, 0}), style));
  return road;
}

std::vector<Lane> mapped(const std::vector<Detection>& road, Lane::Use use) {
  Drive drive(with_strips());
  for (int i = 0; i < 30; ++i) drive.step(road);
  return of_use(drive.mapper.map(), use);
}

TEST(CycleLanes, LieBesideAnEdgeAcrossADashedLine) {
  for (const double width_m : {1.2, 1.5, 1.8, 2.0}) {
    SCOPED_TRACE(width_m);
    const std::vector<Detection> road = Strip{.width_m = width_m, .line = MarkingStyle::dashed}.road();
    const std::vector<Lane> found = mapped(road, Lane::Use::cycle);
    ASSERT_THAT(found, SizeIs(1));
    EXPECT_NEAR(found.front().width_m, width_m, 0.05);
    EXPECT_NEAR(found.front().centerline.front().y(), -1.8 - 0.5 * width_m, 0.05);
    EXPECT_GT(found.front().use_probability, 0.7);
    EXPECT_FALSE(found.front().is_drivable());
    EXPECT_THAT(mapped(road, Lane::Use::lane), SizeIs(2));
  }
}

/// Two lanes, and beyond them whatever is added.
std::vector<Detection> two_lanes() {
  std::vector<Detection> road = Strip{}.road();
  road.pop_back();
  return road;
}

TEST(CycleLanes, LieBetweenTwoLanes) {
  std::vector<Detection> road = with(two_lanes(), MarkingType::laneline, -3.4, MarkingStyle::solid);
  road = with(std::move(road), MarkingType::roadedge, -6.9, MarkingStyle::unknown);
  const std::vector<Lane> found = mapped(road, Lane::Use::cycle);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_NEAR(found.front().centerline.front().y(), -2.6, 0.05);
  EXPECT_THAT(mapped(road, Lane::Use::lane), SizeIs(3));
}

TEST(CycleLanes, LieSideBySide) {
  std::vector<Detection> road = with(two_lanes(), MarkingType::laneline, -3.4, MarkingStyle::dashed);
  road = with(std::move(road), MarkingType::roadedge, -5.0, MarkingStyle::unknown);
  EXPECT_THAT(mapped(road, Lane::Use::cycle), SizeIs(2));
  EXPECT_THAT(mapped(road, Lane::Use::lane), SizeIs(2)) << "none across the line between the two";
}

TEST(CycleLanes, AreNoneBesideALineThatLiesAlone) {
  // A line that is seen double, far from all others.
  std::vector<Detection> road = with({}, MarkingType::laneline, -1.8, MarkingStyle::dashed);
  road = with(std::move(road), MarkingType::laneline, -3.4, MarkingStyle::dashed);
  EXPECT_THAT(mapped(road, Lane::Use::cycle), IsEmpty());
}

/// A road with a strip beside it, and others on it.
class StripWithTraffic {
 public:
  explicit StripWithTraffic(const Strip& strip, const MapperConfig& config = with_strips())
      : drive_(config), strip_(strip) {}

  /// Drives on, past vehicles that stand in the strip at these places, and a cyclist ahead.
  void pass(const std::vector<double>& standing_at_x, bool cyclist = false, double speed_mps = 0.0) {
    for (int i = 0; i < 20; ++i) {
      TrackedObjects objects{.stamp_ns = (drive_.number + 1) * 100'000'000LL, .in_map_frame = true};
      const auto add = [&](ObjectKind kind, double x, double at_mps) {
        objects.objects.push_back({.id = objects.objects.size() + 1,
                                   .kind = kind,
                                   .position = {x, -1.8 - 0.5 * strip_.width_m, 0.0},
                                   .heading = Point::UnitX(),
                                   .speed_mps = at_mps});
      };
      for (const double x : standing_at_x) add(ObjectKind::car, x, speed_mps);
      if (cyclist) add(ObjectKind::bicycle, 5.0 + drive_.x, 10.0);
      drive_.mapper.add(objects, test::at(drive_.x));
      drive_.step(strip_.road());
    }
  }
  const Lane& strip() const {
    return *std::ranges::find_if(drive_.mapper.map().lanes,
                                 [](const Lane& lane) { return !lane.is_drivable(); });
  }
  Mapper& mapper() { return drive_.mapper; }

 private:
  Drive drive_;
  Strip strip_;
};

TEST(ParkingStrips, AreToldByVehiclesThatStandThere) {
  StripWithTraffic road({.width_m = 2.2});
  road.pass({30.0});
  EXPECT_EQ(road.strip().use, Lane::Use::shoulder) << "one may have broken down";
  road.pass({30.0, 40.0, 46.0});
  EXPECT_EQ(road.strip().use, Lane::Use::parking);
  EXPECT_GT(road.strip().use_probability, 0.8);
  EXPECT_FALSE(road.strip().is_drivable());
  road.pass({});
  EXPECT_EQ(road.strip().use, Lane::Use::parking) << "they are remembered";
}

TEST(ParkingStrips, AreForgottenWhereTheVehiclesDroveOff) {
  StripWithTraffic road({.width_m = 2.2});
  road.pass({20.0, 30.0, 36.0});
  ASSERT_EQ(road.strip().use, Lane::Use::parking);
  road.pass({20.0, 30.0, 36.0}, false, 2.0);
  EXPECT_EQ(road.strip().use, Lane::Use::shoulder);
}

TEST(ParkingStrips, AreNotToldByVehiclesInTheLaneBeside) {
  StripWithTraffic road({.width_m = 2.2});
  for (int i = 0; i < 30; ++i) {
    TrackedObjects queue{.stamp_ns = i + 1, .in_map_frame = true};
    for (const double x : {20.0, 26.0, 32.0})
      queue.objects.push_back(
          {.id = queue.objects.size() + 1, .kind = ObjectKind::car, .position = {x, 0.0, 0.0}});
    road.mapper().add(queue, test::at(0.0));
  }
  road.pass({});
  EXPECT_EQ(road.strip().use, Lane::Use::shoulder);
}

TEST(CycleLanes, AreToldByACyclistBehindASolidLine) {
  StripWithTraffic road({.width_m = 1.6});
  road.pass({});
  EXPECT_EQ(road.strip().use, Lane::Use::shoulder);
  const ElementId id = road.strip().id;
  road.pass({}, true);
  road.pass({}, true);
  EXPECT_EQ(road.strip().use, Lane::Use::cycle);
  EXPECT_EQ(road.strip().id, id);
}

TEST(SideStrips, AreNotToldByTrafficThatIsMasked) {
  MapperConfig config = with_strips();
  config.evidence.traffic = false;
  StripWithTraffic road({.width_m = 2.2}, config);
  road.pass({20.0, 30.0, 36.0});
  EXPECT_EQ(road.strip().use, Lane::Use::shoulder);
}

}  // namespace
}  // namespace laneloom
