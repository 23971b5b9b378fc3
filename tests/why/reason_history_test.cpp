#include "why/reason_history.hpp"

#include <gmock/gmock.h>

#include "laneloom/mapper.hpp"
#include "straight_road.hpp"

namespace laneloom::why {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// Adds a frame with these reasons, as a mapper does.
void add(FrameReasons reasons, ReasonHistory& history) {
  history.update_begins();
  *history.reasons() = std::move(reasons);
  history.stage_done(Stage::way);
}

LineReason line_of(LineReason::Verdict verdict) {
  return {.id = 7, .verdict = verdict, .other = 9, .by_stations = 2.5, .by_belief = -0.5, .places = 4};
}

TEST(ReasonHistory, EachVerdictHasItsWords) {
  using enum LineReason::Verdict;
  const std::pair<LineReason::Verdict, const char*> words[] = {
      {confirmed, "laneline 7 is confirmed, with log odds of 2.00; 1.50 are needed."},
      {tentative, "tentative"},
      {held_back, "held back: line 9 lies beside it"},
      {weak, "not published, with log odds of 2.00; 0.50 are needed"},
      {too_short, "min_length_m"},
      {merged, "part of line 9 now"},
      {lost, "in view and not detected"},
      {passed, "left the range"}};
  for (const auto& [verdict, text] : words) {
    ReasonHistory history;
    add({.stamp_ns = 1, .publish = 0.5, .confirm = 1.5, .lines = {line_of(verdict)}}, history);
    EXPECT_THAT(history.of_line(7).at(0), HasSubstr(text));
  }
}

LaneReason lane_of(LaneReason::Verdict verdict) {
  return {.id = 21,
          .verdict = verdict,
          .other = 22,
          .log_odds = 2.5,
          .gained = -0.25,
          .left = {7},
          .observed = 10,
          .found = 4,
          .denied = 3,
          .taken = 1,
          .places = 9,
          .shown = 8,
          .confirmed = 3,
          .inferred = 3,
          .by_trails = 1.5,
          .by_streets = 0.5,
          .direction = 2.0};
}

TEST(ReasonHistory, EachVerdictOnALaneHasItsWords) {
  using enum LaneReason::Verdict;
  const std::pair<LaneReason::Verdict, const char*> words[] = {
      {shown, "Lane 21 is confirmed: at 3 of the 5 places whose borders are seen, both are confirmed"},
      {weak, "not shown: no place has log odds of 1.00, or of 0.00 where"},
      {too_short, "shorter than 2 m"},
      {replaced, "ended: lane 22 lies in its place now"},
      {lost, "ended: it was not found until"},
      {passed, "left the range"}};
  for (const auto& [verdict, text] : words) {
    ReasonHistory history;
    add({.stamp_ns = 1, .show_lane = 1.0, .lanes = {lane_of(verdict)}}, history);
    EXPECT_THAT(history.of_lane(21).at(0), HasSubstr(text));
  }
}

TEST(ReasonHistory, ALaneHasItsTermsThoseOfItsDirectionAndItsLines) {
  ReasonHistory history;
  FrameReasons frame{.stamp_ns = 1'000'000'000,
                     .lines = {line_of(LineReason::Verdict::lost)},
                     .show_lane = 1.0,
                     .lanes = {lane_of(LaneReason::Verdict::shown)}};
  add(frame, history);
  const std::vector<std::string> text = history.of(21, {});
  ASSERT_EQ(text.size(), 8U);
  EXPECT_EQ(
      text[1],
      "Its log odds are 2.50, the mean over its places; a place is shown from 1.00 on, until it falls below "
      "0.00. 8 of 9 places are shown.");
  EXPECT_EQ(text[2],
            "This frame added -0.25: of 10 places known before, it showed the lane at 4, its borders without "
            "a lane "
            "at 3, another lane or a shoulder at 1, nothing at 2.");
  EXPECT_EQ(text[3],
            "That its traffic runs along its points has log odds of +2.00, smoothed over frames: +1.50 by "
            "trails of others, +0.50 by one-way streets of the SD map.");
  EXPECT_EQ(text[4].substr(0, 35), "On its left: laneline 7 is ended: i");
  // A lane that is inferred, or not shown, has fewer.
  frame.lanes[0].inferred = frame.lanes[0].shown;
  add(frame, history);
  EXPECT_THAT(history.of_lane(21).at(0), HasSubstr("inferred: at no place"));
  frame.lanes[0] = lane_of(LaneReason::Verdict::weak);
  add(frame, history);
  EXPECT_THAT(history.of_lane(21), testing::Not(testing::Contains(HasSubstr("traffic"))));
}

TEST(ReasonHistory, WhileTheVehicleStandsTheReasonsOfTheFrameBeforeHold) {
  ReasonHistory history;
  add({.stamp_ns = 1, .publish = 0.5, .lines = {line_of(LineReason::Verdict::weak)}}, history);
  add({.stamp_ns = 2, .repeats = true, .detections = {{.rule = DetectionFate::Rule::repeats}}}, history);
  const nlohmann::json all = history.to_json({.stamp_ns = 2});
  EXPECT_EQ(all["publish"], 0.5);
  EXPECT_TRUE(all["lines"].contains("7"));
  EXPECT_THAT(history.of_detection(0), HasSubstr("the vehicle stands"));
}

TEST(ReasonHistory, ALineThatEndedIsKnownForTenSeconds) {
  ReasonHistory history;
  add({.stamp_ns = 1'000'000'000, .lines = {line_of(LineReason::Verdict::lost)}}, history);
  add({.stamp_ns = 2'000'000'000}, history);
  EXPECT_EQ(history.of_line(7).at(0), "This was 1.0 s ago.");
  add({.stamp_ns = 11'100'000'000}, history);
  EXPECT_THAT(history.of_line(7), IsEmpty());
}

/// The line that a lane lay on may end long before the lane does.
TEST(ReasonHistory, ALaneKnowsTheLinesThatItLayOn) {
  ReasonHistory history;
  LaneReason lane = lane_of(LaneReason::Verdict::shown);
  add({.stamp_ns = 1'000'000'000, .lines = {line_of(LineReason::Verdict::lost)}, .lanes = {lane}}, history);
  add({.stamp_ns = 8'000'000'000, .lanes = {lane}}, history);
  LocalMap map{.stamp_ns = 8'000'000'000};
  map.lanes = {{.id = 21, .left_borders = {{kNoElement, {0, 10}, {}}}}};
  EXPECT_THAT(history.of(21, map), testing::Contains("On its left: This was 7.0 s ago."));
  const nlohmann::json all = history.to_json(map);
  EXPECT_EQ(all["lanes"]["21"]["lines"], nlohmann::json({7}));
  EXPECT_EQ(all["lines"]["7"]["text"][0], "This was 7.0 s ago.");
  // What no lane lay on is told for three seconds.
  lane.left.clear();
  add({.stamp_ns = 8'100'000'000, .lanes = {lane}}, history);
  map.stamp_ns = 8'100'000'000;
  EXPECT_FALSE(history.to_json(map).contains("lines"));
}

TEST(ReasonHistory, TellsOfARealMapper) {
  Mapper mapper{MapperConfig{}};
  ReasonHistory history;
  for (std::int64_t ms = 1000; ms <= 4000; ms += 100)
    mapper.update(frame_on_straight_road(ms, 100), transform(pose_on_straight_road(ms - 40)), &history);
  const LocalMap& map = mapper.map();
  ASSERT_EQ(map.lanes.size(), 1U);
  const std::vector<std::string> lane = history.of(map.lanes[0].id, map);
  EXPECT_THAT(lane.at(0), HasSubstr("is confirmed: at"));
  EXPECT_THAT(lane, testing::Contains(HasSubstr("its traffic runs along its points")));
  EXPECT_THAT(lane, testing::Contains(HasSubstr("Left side")));
  EXPECT_THAT(lane, testing::Contains(HasSubstr("Right side")));
  EXPECT_THAT(history.of(map.boundaries[0].id, map).back(), HasSubstr("frames did."));
  EXPECT_THAT(history.of_detection(0), HasSubstr("taken: it observes line"));
  EXPECT_EQ(history.of_detection(2), "");
  const nlohmann::json all = history.to_json(map);
  EXPECT_EQ(all["detections"].size(), 2U);
  EXPECT_GT(all["lanes"][std::to_string(map.lanes[0].id)]["log_odds"], all["show_lane"]);
  EXPECT_TRUE(all["lines"].contains(std::to_string(map.boundaries[0].id)));
}

TEST(ReasonHistory, TheMethodVoxelsGivesNone) {
  MapperConfig config;
  config.method = FusionMethod::voxels;
  Mapper mapper{config};
  ReasonHistory history;
  mapper.update(frame_on_straight_road(1000, 100), transform(pose_on_straight_road(960)), &history);
  EXPECT_TRUE(history.to_json(mapper.map()).is_null());
}

}  // namespace
}  // namespace laneloom::why
