#include <gmock/gmock.h>

#include <algorithm>
#include <stdexcept>

#include "laneloom/mapper.hpp"
#include "laneloom/reasons.hpp"
#include "mapping/asking.hpp"

namespace laneloom {
namespace {

using Verdict = LaneReason::Verdict;

constexpr std::int64_t kPeriod_ms = 100;

/// A drive on a straight road between two lines, whose frames can be emptied.
class LaneDrive {
 public:
  const LocalMap& next(bool empty = false) {
    time_ms_ += kPeriod_ms;
    DetectionFrame frame = seen_on_straight_road(time_ms_, kPeriod_ms);
    if (empty) frame.detections.clear();
    return mapper_.update(frame, transform(pose_on_straight_road(time_ms_ - 40)), &asking_);
  }
  const FrameReasons& reasons() const { return asking_.now; }
  const LaneReason& of(ElementId id) const {
    const auto found = std::ranges::find(asking_.now.lanes, id, &LaneReason::id);
    if (found == asking_.now.lanes.end()) throw std::runtime_error("no reasons of the lane");
    return *found;
  }

 private:
  Mapper mapper_{MapperConfig{}};
  Asking asking_;
  std::int64_t time_ms_ = 1000;
};

TEST(LaneReasons, TheLanesOfTheMapAreThoseThatAreShown) {
  LaneDrive drive;
  for (int i = 0; i < 40; ++i) {
    const LocalMap& map = drive.next();
    std::vector<ElementId> shown, in_map;
    for (const LaneReason& lane : drive.reasons().lanes)
      if (lane.verdict == Verdict::shown) shown.push_back(lane.id);
    for (const Lane& lane : map.lanes) in_map.push_back(lane.id);
    ASSERT_THAT(shown, testing::UnorderedElementsAreArray(in_map));
    for (const Lane& lane : map.lanes) {
      const LaneReason& reason = drive.of(lane.id);
      EXPECT_EQ(2 * reason.confirmed > reason.shown - reason.inferred,
                lane.status == ElementStatus::confirmed);
      EXPECT_LE(reason.shown, reason.places);
      EXPECT_LE(reason.found + reason.denied + reason.taken, reason.observed);
      EXPECT_EQ(reason.left, (std::vector{lane.left_borders.at(0).boundary}));
      EXPECT_EQ(reason.right, (std::vector{lane.right_borders.at(0).boundary}));
    }
  }
}

TEST(LaneReasons, EvidenceIsTheSumOfWhatFramesAdded) {
  LaneDrive drive;
  for (int i = 0; i < 10; ++i) drive.next();
  const ElementId id = drive.next().lanes.at(0).id;
  EXPECT_GT(drive.of(id).gained, 0.0);
  EXPECT_GT(drive.of(id).found, 10U);
  EXPECT_GE(drive.of(id).log_odds, drive.reasons().show_lane);
  EXPECT_EQ(drive.reasons().hide_lane, 0.0);
}

TEST(LaneReasons, TheOwnDriveTellsTheDirection) {
  LaneDrive drive;
  for (int i = 0; i < 20; ++i) drive.next();
  const Lane& lane = drive.next().lanes.at(0);
  ASSERT_EQ(lane.direction, Lane::Direction::along_centerline);
  const LaneReason& reason = drive.of(lane.id);
  EXPECT_GT(reason.by_drive, 1.0);
  EXPECT_EQ(reason.by_trails, 0.0);
  EXPECT_EQ(reason.by_beside, 0.0);
  EXPECT_GT(reason.direction, 1.0);
}

TEST(LaneReasons, ALaneWhoseLinesAreMissedEndsAsLost) {
  LaneDrive drive;
  for (int i = 0; i < 20; ++i) drive.next();
  const ElementId id = drive.next().lanes.at(0).id;
  bool fell = false;
  for (int i = 0; i < 300; ++i) {
    drive.next(true);
    const LaneReason& reason = drive.of(id);  // it ends with a reason
    fell = fell || reason.gained < 0.0;
    if (reason.verdict <= Verdict::too_short) continue;
    EXPECT_EQ(reason.verdict, Verdict::lost);
    EXPECT_TRUE(fell);
    EXPECT_FALSE(reason.left.empty());
    return;
  }
  FAIL() << "the lane never ended";
}

}  // namespace
}  // namespace laneloom
