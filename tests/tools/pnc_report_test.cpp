#include "pnc/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "laneloom/way.hpp"

namespace laneloom {
namespace {

using testing::HasSubstr;

/// The vehicle in lane 5, 3 m wide and 15 m long.
PublishedMap map_with_lane() {
  PublishedMap map;
  map.sequence = 9;
  map.session_id = 1;
  map.state = MapState::ok;
  map.age_s = 0.05;
  map.map.stamp_ns = 1;
  map.map.T_map_body.translation() = Point(1, 1, 0);
  Marking right;
  right.id = 1;
  right.points = {{0, 0, 0}, {15, 0, 0}};
  Marking left = right;
  left.id = 2;
  for (Point& point : left.points) point.y() = 3.0;
  Lane lane;
  lane.id = 5;
  lane.left = left.points;
  lane.right = right.points;
  lane.centerline = {{0, 1.5, 0}, {15, 1.5, 0}};
  lane.left_borders = {{2, {0.0, 15.0}, {0.0, 15.0}}};
  lane.right_borders = {{1, {0.0, 15.0}, {0.0, 15.0}}};
  lane.evidence = Evidence::markings;
  lane.width_m = 3.0;
  map.map.boundaries = {right, left};
  map.map.lanes = {lane};
  map.map.way = way_ahead(LaneGraph(map.map), map.map.T_map_body, WayWish::straight);
  return map;
}

TEST(PncReport, TellsWhatAPlannerNeeds) {
  PublishedMap previous = map_with_lane();
  previous.sequence = 6;
  const pnc::PncUpdate update = pnc::judge(map_with_lane(), &previous);
  EXPECT_TRUE(update.violations.empty());
  const nlohmann::json json = to_json(update);
  EXPECT_EQ(json.at("state"), "OK");
  EXPECT_EQ(json.at("age_s"), 0.05);
  EXPECT_EQ(json.at("missed"), 2);
  EXPECT_EQ(json.at("lanes"), 1);
  EXPECT_EQ(json.at("ego").at("lane"), 5);
  EXPECT_TRUE(json.at("ego").at("left_neighbour").is_null());
  EXPECT_EQ(json.at("ego").at("width_ahead").at(0).at("width_m"), 3.0);
  EXPECT_TRUE(json.at("ego").at("width_ahead").at(1).at("width_m").is_null());
  EXPECT_THAT(describe(update), HasSubstr("10 m: 3.00 m   20 m: -"));
  EXPECT_NEAR(json.at("way").at("known_m").get<double>(), 14.0, 1e-9);
  EXPECT_NEAR(json.at("way").at("width_m").get<double>(), 3.0, 1e-9);
  EXPECT_THAT(describe(update), HasSubstr("way             14 m, 14 m of it confirmed, curvature here"));
}

TEST(PncReport, DoesNotDriveOnAMapThatBreaksItsContract) {
  PublishedMap map = map_with_lane();
  map.map.lanes[0].left_borders = {{.boundary = 99}};
  const pnc::PncUpdate update = pnc::judge(map, nullptr);
  EXPECT_EQ(update.ego.lane, kNoElement);
  EXPECT_THAT(describe(update), HasSubstr("VIOLATION       known_ids"));
  EXPECT_THAT(summarise(update), HasSubstr("VIOLATION known_ids"));
  EXPECT_EQ(to_json(update).at("violations").at(0).at("rule"), "known_ids");
}

TEST(PncReport, SaysWhyAMapIsNotOk) {
  PublishedMap map;
  map.state = MapState::stale;
  map.reasons = {StateReason::no_poses, StateReason::starting};
  const pnc::PncUpdate update = pnc::judge(map, nullptr);
  EXPECT_THAT(describe(update), HasSubstr("STALE no_poses starting   age nothing fused yet"));
  EXPECT_TRUE(to_json(update).at("age_s").is_null());
  EXPECT_EQ(to_json(update).at("reasons"), (nlohmann::json{"no_poses", "starting"}));
}

}  // namespace
}  // namespace laneloom
