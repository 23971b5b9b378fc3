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
  history.stage_done(Stage::polylines);
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

TEST(ReasonHistory, ALineThatEndedIsKnownForThreeSeconds) {
  ReasonHistory history;
  add({.stamp_ns = 1'000'000'000, .lines = {line_of(LineReason::Verdict::lost)}}, history);
  add({.stamp_ns = 2'000'000'000}, history);
  EXPECT_EQ(history.of_line(7).at(0), "This was 1.0 s ago.");
  add({.stamp_ns = 5'000'000'000}, history);
  EXPECT_THAT(history.of_line(7), IsEmpty());
}

TEST(ReasonHistory, TellsOfARealMapper) {
  Mapper mapper{MapperConfig{}};
  ReasonHistory history;
  for (std::int64_t ms = 1000; ms <= 4000; ms += 100)
    mapper.update(frame_on_straight_road(ms, 100), transform(pose_on_straight_road(ms - 40)), &history);
  const LocalMap& map = mapper.map();
  ASSERT_EQ(map.lanes.size(), 1U);
  const std::vector<std::string> lane = history.of(map.lanes[0].id, map);
  EXPECT_THAT(lane, testing::Contains(HasSubstr("Left side")));
  EXPECT_THAT(lane, testing::Contains(HasSubstr("Right side")));
  EXPECT_THAT(history.of(map.boundaries[0].id, map).back(), HasSubstr("frames did."));
  EXPECT_THAT(history.of_detection(0), HasSubstr("taken: it observes line"));
  EXPECT_EQ(history.of_detection(2), "");
  const nlohmann::json all = history.to_json(map);
  EXPECT_EQ(all["detections"].size(), 2U);
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
