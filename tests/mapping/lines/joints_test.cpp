#include "mapping/lines/joints.hpp"

#include <gmock/gmock.h>

#include "mapping/shapes.hpp"

namespace laneloom::lines {
namespace {

using test::line;
using test::straight;

class Joints : public ::testing::Test {
 protected:
  /// A frame with detections along these lines.
  void frame(const std::vector<Polyline>& seen, double max_gap_m = 5.0) {
    std::vector<markings::ObservedMarking> markings;
    for (const Polyline& points : seen)
      markings.push_back({.type = MarkingType::laneline, .confidence = 0.9, .points = points});
    count_joints(LineMatcher(lines_, {}).match(sample_detections(markings, {})), lines_, max_gap_m, joints_);
  }

  const Polyline first_ = straight({0, 0, 0}, {10, 0, 0}, 11), second_ = straight({12, 0, 0}, {22, 0, 0}, 11),
                 both_ = straight({0, 0, 0}, {22, 0, 0}, 23);
  std::vector<Line> lines_{line(1, first_), line(2, second_)};
  markings::PairHistories joints_;

  const markings::PairHistory* joint() const {
    return find(joints_, markings::end_id(1, End::back), markings::end_id(2, End::front));
  }
  bool separate() const { return joint() != nullptr && seen_apart(*joint()); }
};

TEST_F(Joints, WhatIsAlwaysSeenAsTwoIsTwo) {
  for (int i = 0; i < 3; ++i) frame({first_, second_});
  EXPECT_FALSE(separate());  // too early to tell
  for (int i = 0; i < 5; ++i) frame({first_, second_});
  EXPECT_TRUE(separate());
}

TEST_F(Joints, WhatIsOftenSeenAsOneIsOne) {
  for (int i = 0; i < 15; ++i) {
    frame({both_});
    frame({first_, second_});
  }
  EXPECT_FALSE(separate());
}

TEST_F(Joints, ADetectionThatRanThroughBothEndsMakesThemOne) {
  for (int i = 0; i < 2; ++i) frame({both_});
  ASSERT_NE(joint(), nullptr);
  EXPECT_TRUE(seen_together(*joint()));
}

TEST_F(Joints, BothTipsOfAnIslandAreJoints) {
  const Polyline near = straight({0, 0, 0}, {10, 0, 0}, 11);
  lines_ = {line(1, near), line(2, straight({0, 2, 0}, {10, 2, 0}, 11))};
  frame({near, straight({0, 2, 0}, {10, 2, 0}, 11)});
  EXPECT_NE(find(joints_, markings::end_id(1, End::front), markings::end_id(2, End::front)), nullptr);
  EXPECT_NE(find(joints_, markings::end_id(1, End::back), markings::end_id(2, End::back)), nullptr);
}

TEST_F(Joints, SeeingOnlyOneOfThemSaysNothing) {
  for (int i = 0; i < 30; ++i) frame({first_});
  EXPECT_FALSE(separate());
}

TEST_F(Joints, EndsFarFromEachOtherAreNone) {
  for (int i = 0; i < 30; ++i) frame({first_, second_}, 1.5);
  EXPECT_TRUE(joints_.empty());
}

TEST_F(Joints, LinesSideBySideThatRunOnAreNone) {
  lines_ = {line(1, straight({0, 0, 0}, {40, 0, 0}, 41)), line(2, straight({10, 3, 0}, {30, 3, 0}, 21))};
  frame({both_});
  EXPECT_TRUE(joints_.empty());
}

}  // namespace
}  // namespace laneloom::lines
