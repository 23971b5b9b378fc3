#include "mapping/lines/line_merging.hpp"

#include <gmock/gmock.h>

#include "mapping/shapes.hpp"

namespace laneloom::lines {
namespace {

using test::line;
using test::straight;

class LineMerging : public ::testing::Test {
 protected:
  LineMerging() {
    lines_ = {line(1, straight({0, 0, 0}, {20, 0, 0}, 21)), line(2, straight({2, 0.4, 0}, {18, 0.4, 0}, 17))};
    for (Station& station : lines_[0].stations) station.log_odds = 3.0;
  }
  void frame(bool first, bool second) {
    for (Station& station : lines_[0].stations) station.sight = first ? Sight::observed : Sight::missed;
    for (Station& station : lines_[1].stations) station.sight = second ? Sight::observed : Sight::missed;
    merge();
  }
  void merge() { merged_ = merge_doubles({}, station_grid(lines_), lines_, pairs_); }
  std::vector<Line> lines_;
  markings::PairHistories pairs_;
  std::vector<markings::Relative> merged_;
};

TEST_F(LineMerging, ADoubleThatIsNeverSeenWithTheLineGoes) {
  for (int i = 0; i < 3; ++i) frame(i % 2 == 0, i % 2 != 0);
  EXPECT_EQ(lines_.size(), 2U);  // too early to tell
  for (int i = 0; i < 3 && lines_.size() == 2; ++i) frame(i % 2 == 0, i % 2 != 0);
  ASSERT_EQ(lines_.size(), 1U);
  EXPECT_EQ(lines_[0].id, 1U);
  ASSERT_EQ(merged_.size(), 1U);
  EXPECT_EQ(merged_[0].id, 2U);
  EXPECT_EQ(merged_[0].other, 1U);
}

TEST_F(LineMerging, TwoLinesThatAreSeenTogetherStay) {
  for (int i = 0; i < 100; ++i) frame(true, i % 2 == 0);
  EXPECT_EQ(lines_.size(), 2U);
}

TEST_F(LineMerging, WhatIsOutOfViewDoesNotTell) {
  for (Station& station : lines_[1].stations) station.sight = Sight::observed;
  for (std::size_t k = 0; k < 8; ++k) lines_[0].stations[k].sight = Sight::observed;
  for (int i = 0; i < 100; ++i) merge();
  EXPECT_EQ(lines_.size(), 2U) << "both are seen as far as the camera looks";
  for (Station& station : lines_[0].stations) station.sight = Sight::out_of_view;
  for (int i = 0; i < 100; ++i) merge();
  EXPECT_EQ(lines_.size(), 2U) << "a truck hides one of them";
}

TEST_F(LineMerging, TwoRoadEdgesWithoutRoomBetweenThemAreOne) {
  for (Line& line : lines_)
    for (Station& station : line.stations) station.type_votes[index(MarkingType::roadedge)] = 1.0e6;
  frame(true, true);
  EXPECT_EQ(lines_.size(), 2U) << "0.4 m apart";
  for (Station& station : lines_[1].stations) station.position.y() = 0.25;
  frame(true, true);
  ASSERT_EQ(lines_.size(), 1U);
  EXPECT_EQ(lines_[0].id, 1U);
}

TEST_F(LineMerging, TwoLanelinesThatWouldTouchAreOne) {
  for (Station& station : lines_[1].stations) station.position.y() = 0.12;
  frame(true, true);
  ASSERT_EQ(lines_.size(), 1U);
  EXPECT_EQ(lines_[0].id, 1U);
}

TEST_F(LineMerging, LanelinesThatConvergeStay) {
  for (Station& station : lines_[1].stations) {
    const double diverged_m = std::max(0.0, 0.1 * (station.position.x() - 14.0));
    station.position.y() = 0.1 + diverged_m;
  }
  for (int i = 0; i < 100; ++i) frame(true, true);
  EXPECT_EQ(lines_.size(), 2U);
}

TEST_F(LineMerging, ALanelineAtTheFootOfAKerbIsNoDouble) {
  for (Station& station : lines_[1].stations) {
    station.position.y() = 0.12;
    station.type_votes[index(MarkingType::roadedge)] = 1.0e6;
  }
  for (int i = 0; i < 100; ++i) frame(true, true);
  EXPECT_EQ(lines_.size(), 2U);
}

TEST_F(LineMerging, ThePaintOfADoubleLineStays) {
  for (Station& station : lines_[1].stations) station.position.y() = 0.25;
  for (int i = 0; i < 100; ++i) frame(true, true);
  EXPECT_EQ(lines_.size(), 2U);
}

TEST_F(LineMerging, LinesApartAreNoPair) {
  for (Station& station : lines_[1].stations) station.position.y() = 1.5;
  for (int i = 0; i < 100; ++i) frame(i % 2 == 0, i % 2 != 0);
  EXPECT_EQ(lines_.size(), 2U);
  EXPECT_TRUE(pairs_.empty());
}

TEST_F(LineMerging, ABridgeIsNoDoubleOfTheRoadBelow) {
  for (Station& station : lines_[1].stations) station.position.z() = 6.0;
  for (int i = 0; i < 100; ++i) frame(i % 2 == 0, i % 2 != 0);
  EXPECT_EQ(lines_.size(), 2U);
}

}  // namespace
}  // namespace laneloom::lines
