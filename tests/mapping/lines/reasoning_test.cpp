#include <gmock/gmock.h>

#include <algorithm>

#include "laneloom/mapper.hpp"
#include "laneloom/reasons.hpp"
#include "mapping/asking.hpp"

namespace laneloom {
namespace {

using Rule = DetectionFate::Rule;
using Verdict = LineReason::Verdict;
using testing::ElementsAre;

constexpr std::int64_t kPeriod_ms = 100;

/// A drive on a straight road, whose frames can be changed.
class AskedDrive {
 public:
  template <class Change>
  const LocalMap& next(StageObserver* observer, const Change& change) {
    time_ms_ += kPeriod_ms;
    DetectionFrame frame = seen_on_straight_road(time_ms_, kPeriod_ms);
    change(frame);
    return mapper_.update(frame, transform(pose_on_straight_road(time_ms_ - 40)), observer);
  }
  const LocalMap& next(StageObserver* observer) {
    return next(observer, [](DetectionFrame&) {});
  }
  std::string state() const { return mapper_.save(); }

 private:
  Mapper mapper_{MapperConfig{}};
  std::int64_t time_ms_ = 1000;
};

const LineReason& of(ElementId id, const FrameReasons& frame) {
  const auto found = std::ranges::find(frame.lines, id, &LineReason::id);
  if (found == frame.lines.end()) throw std::runtime_error("no reasons of the line");
  return *found;
}

TEST(Reasons, DetectionsBeginLinesAndThenObserveThem) {
  AskedDrive drive;
  Asking asking;
  drive.next(&asking);
  ASSERT_EQ(asking.now.detections.size(), 2U);
  ASSERT_EQ(asking.now.detections[0].rule, Rule::begins);
  ASSERT_EQ(asking.now.detections[0].lines.size(), 1U);
  const ElementId line = asking.now.detections[0].lines[0];
  EXPECT_THAT(of(line, asking.now).detections, ElementsAre(0U));
  drive.next(&asking);
  EXPECT_EQ(asking.now.detections[0].rule, Rule::observes);
  EXPECT_THAT(asking.now.detections[0].lines, ElementsAre(line));
  const LineReason& reason = of(line, asking.now);
  EXPECT_THAT(reason.detections, ElementsAre(0U));
  EXPECT_GT(reason.gained, 0.0);
  EXPECT_GT(reason.observed, 20U);
  EXPECT_LE(reason.observed + reason.missed, reason.places);
}

TEST(Reasons, TheVerdictIsWhatIsPublished) {
  AskedDrive drive;
  Asking asking;
  for (int i = 0; i < 30; ++i) {
    const LocalMap& map = drive.next(&asking);
    for (const LineReason& reason : asking.now.lines) {
      const auto marking = std::ranges::find(map.markings, reason.id, &Marking::id);
      const bool published = reason.verdict == Verdict::confirmed || reason.verdict == Verdict::tentative;
      ASSERT_EQ(published, marking != map.markings.end());
      if (!published) continue;
      EXPECT_EQ(reason.verdict == Verdict::confirmed, marking->status == ElementStatus::confirmed);
    }
  }
  EXPECT_TRUE(std::ranges::all_of(asking.now.lines,
                                  [](const LineReason& line) { return line.verdict == Verdict::confirmed; }));
}

TEST(Reasons, WhatIsDroppedNamesItsRule) {
  AskedDrive drive;
  Asking asking;
  drive.next(&asking, [](DetectionFrame& frame) {
    frame.detections.push_back({.confidence = 0.01, .points = {{0, 5, 0}, {20, 5, 0}}});
    frame.detections.push_back(
        {.confidence = 0.9,
         .points = {
             {0, 8, 0}, {3, 8, 0}, {3, 5, 0}, {6, 5, 0}, {6, 8, 0}, {9, 8, 0}, {9, 5, 0}, {12, 5, 0}}});
    frame.detections.push_back({.confidence = 0.9, .points = {{10, -6, 0}, {10.2, -6, 0}}});
  });
  EXPECT_EQ(asking.now.detections[2].rule, Rule::unsure);
  EXPECT_EQ(asking.now.detections[3].rule, Rule::zigzag);
  EXPECT_EQ(asking.now.detections[4].rule, Rule::unused);
}

TEST(Reasons, ALineThatIsMissedForLongEndsAsLost) {
  AskedDrive drive;
  Asking asking;
  for (int i = 0; i < 5; ++i) drive.next(&asking);
  const ElementId left = asking.now.detections[1].lines.at(0);
  const auto without_left = [](DetectionFrame& frame) { frame.detections.pop_back(); };
  bool missed = false;
  for (int i = 0; i < 200; ++i) {
    drive.next(&asking, without_left);
    const LineReason& reason = of(left, asking.now);
    missed = missed || (reason.missed > 0 && reason.gained < 0.0);
    if (reason.verdict != Verdict::lost) continue;
    EXPECT_TRUE(missed);
    return;
  }
  FAIL() << "the line never ended";
}

TEST(Reasons, AskingChangesNothing) {
  AskedDrive asked, silent;
  Asking asking;
  for (int i = 0; i < 30; ++i) {
    asked.next(&asking);
    silent.next(nullptr);
  }
  EXPECT_EQ(asked.state(), silent.state());
}

}  // namespace
}  // namespace laneloom
