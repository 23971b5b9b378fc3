#include "mapping/lines/joints.hpp"

#include <gmock/gmock.h>

#include "mapping/shapes.hpp"

namespace laneloom {
namespace {

using test::line;
using test::straight;

class Joints : public ::testing::Test {
 protected:
  /// A frame with detections along these lines.
  void frame(const std::vector<Polyline>& seen, double max_gap_m = 5.0) {
    std::vector<ObservedMarking> markings;
    for (const Polyline& points : seen)
      markings.push_back({.type = MarkingType::laneline, .confidence = 0.9, .points = points});
    count_joints(LineMatcher(lines_, {}).match(sample_detections(markings, {})), lines_, max_gap_m, joints_);
  }

  const Polyline first_ = straight({0, 0, 0}, {10, 0, 0}, 11), second_ = straight({12, 0, 0}, {22, 0, 0}, 11),
                 both_ = straight({0, 0, 0}, {22, 0, 0}, 23);
  std::vector<Line> lines_{line(1, first_), line(2, second_)};
  PairHistories joints_;
};

TEST_F(Joints, WhatIsAlwaysSeenAsTwoIsTwo) {
  for (int i = 0; i < 3; ++i) frame({first_, second_});
  EXPECT_FALSE(are_separate(joints_, 1, 2));  // too early to tell
  for (int i = 0; i < 5; ++i) frame({first_, second_});
  EXPECT_TRUE(are_separate(joints_, 1, 2));
  EXPECT_TRUE(are_separate(joints_, 2, 1));
}

TEST_F(Joints, WhatIsOftenSeenAsOneIsOne) {
  for (int i = 0; i < 15; ++i) {
    frame({both_});
    frame({first_, second_});
  }
  EXPECT_FALSE(are_separate(joints_, 1, 2));
}

TEST_F(Joints, SeeingOnlyOneOfThemSaysNothing) {
  for (int i = 0; i < 30; ++i) frame({first_});
  EXPECT_FALSE(are_separate(joints_, 1, 2));
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
}  // namespace laneloom
