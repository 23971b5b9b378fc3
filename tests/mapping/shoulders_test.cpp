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

MapperConfig with_shoulders() {
  MapperConfig config;
  config.lane.publish_shoulders = true;
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
  Drive drive(with_shoulders());
  return of_use(drive_on(drive, strip), Lane::Use::shoulder);
}

TEST(Shoulders, LieBetweenASolidLineAndAnEdge) {
  for (double width_m = 1.0; width_m < 2.7; width_m += 0.2) {
    SCOPED_TRACE(width_m);
    Drive drive(with_shoulders());
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

TEST(Shoulders, AreNoneBesideADashedLineOrOneWhoseStyleIsNotKnown) {
  EXPECT_THAT(shoulders_beside({.line = MarkingStyle::dashed}), IsEmpty());
  EXPECT_THAT(shoulders_beside({.line = MarkingStyle::unknown}), IsEmpty());
}

TEST(Shoulders, AreNoneWhereThereIsRoomForALane) {
  EXPECT_THAT(shoulders_beside({.width_m = 3.4}), IsEmpty());
  EXPECT_THAT(shoulders_beside({.width_m = 0.4}), IsEmpty());
}

TEST(Shoulders, AreNotInTheMapUnlessTheConfigurationSaysSo) {
  Drive drive;
  EXPECT_THAT(of_use(drive_on(drive, {}), Lane::Use::shoulder), IsEmpty());
}

TEST(Shoulders, LeaveLanesAndTheWayAsTheyAre) {
  Drive with(with_shoulders()), without;
  const LocalMap &both = drive_on(with, {}), &lanes = drive_on(without, {});
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

TEST(Shoulders, KeepTheirIds) {
  Drive drive(with_shoulders());
  const ElementId id = of_use(drive_on(drive, {}), Lane::Use::shoulder).front().id;
  for (int i = 0; i < 50; ++i) {
    const std::vector<Lane> shoulders = of_use(drive_on(drive, {}, 1), Lane::Use::shoulder);
    ASSERT_THAT(shoulders, SizeIs(1));
    EXPECT_EQ(shoulders.front().id, id);
  }
}

TEST(Shoulders, HaveReasons) {
  Asking observer;
  Drive drive(with_shoulders());
  for (int i = 0; i < 10; ++i) drive.step(Strip{}.road(), &observer);
  const Lane shoulder = of_use(drive.mapper.map(), Lane::Use::shoulder).front();
  const auto reason = std::ranges::find(observer.now.lanes, shoulder.id, &LaneReason::id);
  ASSERT_NE(reason, observer.now.lanes.end());
  EXPECT_EQ(reason->verdict, LaneReason::Verdict::shown);
  EXPECT_EQ(observer.now.lanes.size(), 3U) << "with the two lanes";
}

TEST(Shoulders, GiveWayToALane) {
  Drive drive(with_shoulders());
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

TEST(Shoulders, AreSavedWithTheMap) {
  Drive drive(with_shoulders());
  drive_on(drive, {});
  Drive resumed(with_shoulders());
  resumed.mapper.load(drive.mapper.save());
  resumed.x = drive.x;
  resumed.number = drive.number;
  drive_on(drive, {}, 1);
  drive_on(resumed, {}, 1);
  EXPECT_EQ(drive.mapper.save(), resumed.mapper.save());
}

TEST(Shoulders, GoAlongWithPosesThatJump) {
  Drive drive(with_shoulders());
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

}  // namespace
}  // namespace laneloom
