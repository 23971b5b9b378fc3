#include "mapping/lines/line_joining.hpp"

#include <gmock/gmock.h>

#include "mapping/shapes.hpp"

namespace laneloom::lines {
namespace {

using test::line;
using test::straight;

/// Whether each station lies at least half a metre ahead of the one before, along x.
bool runs_forth(const Line& line) {
  const auto is_close = [](const Station& a, const Station& b) {
    return b.position.x() - a.position.x() < 0.5;
  };
  return std::ranges::adjacent_find(line.stations, is_close) == line.stations.end();
}

class LineJoining : public ::testing::Test {
 protected:
  /// A joint through which detections ran in `frames` frames.
  void joint(End first_end, End second_end, double frames = 10.0, double apart = 0.0) {
    joints_ = {{markings::end_id(1, first_end), markings::end_id(2, second_end), frames, apart}};
  }
  void join() { joined_ = join_lines({}, joints_, station_grid(lines_), lines_, overlaps_); }

  std::vector<Line> lines_;
  markings::PairHistories joints_, overlaps_;
  std::vector<Joined> joined_;
};

class Meeting : public LineJoining {
 protected:
  Meeting() {
    lines_ = {line(1, straight({0, 0, 0}, {10, 0, 0}, 11)),
              line(2, straight({11, 0.2, 0}, {20, 0.2, 0}, 10))};
  }
};

TEST_F(Meeting, EndsThatDetectionsRunThroughAreJoinedAndTheOlderLineStays) {
  lines_[0].observations = 30;
  lines_[1].observations = 4;
  lines_[1].last_seen_ns = 7;
  std::ranges::swap(lines_[0], lines_[1]);  // the order in memory does not matter
  joint(End::back, End::front);
  join();
  ASSERT_EQ(lines_.size(), 1U);
  EXPECT_EQ(lines_[0].id, 1U);
  EXPECT_EQ(lines_[0].stations.size(), 21U);
  EXPECT_TRUE(runs_forth(lines_[0]));
  EXPECT_EQ(lines_[0].observations, 30U) << "one detection observed both";
  EXPECT_EQ(lines_[0].last_seen_ns, 7);
  ASSERT_EQ(joined_.size(), 1U);
  EXPECT_EQ(joined_[0].stays, 1U);
  EXPECT_EQ(joined_[0].end, End::back);
  EXPECT_EQ(joined_[0].gone, 2U);
  EXPECT_EQ(joined_[0].gone_end, End::front);
}

TEST_F(Meeting, AFewFramesAreTooEarlyToTell) {
  joint(End::back, End::front, 7.9);
  join();
  EXPECT_EQ(lines_.size(), 2U);
}

TEST_F(Meeting, EndsThatAreSeenApartMoreOftenStayTwo) {
  joint(End::back, End::front, 10.0, 11.0);
  join();
  EXPECT_EQ(lines_.size(), 2U);
}

TEST_F(Meeting, WithoutAJointNothingIsJoined) {
  join();
  EXPECT_EQ(lines_.size(), 2U);
}

TEST_F(Meeting, TheOlderLineIsContinuedAtItsFront) {
  lines_[1] = line(2, straight({-10, 0, 0}, {-1, 0, 0}, 10));
  joint(End::front, End::back);
  join();
  ASSERT_EQ(lines_.size(), 1U);
  EXPECT_EQ(lines_[0].stations.size(), 21U);
  EXPECT_TRUE(runs_forth(lines_[0]));
}

TEST_F(Meeting, LeftAndRightOfALineThatRanTheOtherWayAreSwapped) {
  lines_[1] = line(2, straight({20, 0, 0}, {11, 0, 0}, 10));
  for (Station& station : lines_[1].stations) {
    station.moved_m = 0.3;
    station.far_views[0].lateral_m = 0.2;
    station.far_views[0].suspected_m = {0.1, 0.2, -0.1};
  }
  joint(End::back, End::back);
  join();
  ASSERT_EQ(lines_.size(), 1U);
  EXPECT_TRUE(runs_forth(lines_[0]));
  const Station& last = lines_[0].stations.back();
  EXPECT_DOUBLE_EQ(last.position.x(), 20.0);
  EXPECT_DOUBLE_EQ(last.moved_m, -0.3);
  EXPECT_DOUBLE_EQ(last.far_views[0].lateral_m, -0.2);
  EXPECT_EQ(last.far_views[0].suspected_m, PerSuspicion(-0.1, -0.2, 0.1));
  EXPECT_DOUBLE_EQ(lines_[0].stations.front().moved_m, 0.0);
}

TEST_F(Meeting, AReversedLineThatIsNotJoinedIsLeftAsItWas) {
  lines_[1] = line(2, straight({20, 0, 0}, {13, 0, 0}, 8));
  lines_[1].stations.front().moved_m = 0.3;
  joint(End::back, End::back);
  join();
  ASSERT_EQ(lines_.size(), 2U);
  EXPECT_DOUBLE_EQ(lines_[1].stations.front().position.x(), 20.0);
  EXPECT_DOUBLE_EQ(lines_[1].stations.front().moved_m, 0.3);
}

TEST_F(Meeting, ALineIsNotExtendedAcrossAGap) {
  lines_[1] = line(2, straight({12, 0, 0}, {20, 0, 0}, 9));
  joint(End::back, End::front);
  join();
  EXPECT_EQ(lines_.size(), 2U) << "the boundary bridges it, and says so";
}

TEST_F(Meeting, LinesOfTwoTypesStayTwo) {
  lines_[1] = line(2, straight({11, 0, 0}, {20, 0, 0}, 10), MarkingType::roadedge);
  joint(End::back, End::front);
  join();
  EXPECT_EQ(lines_.size(), 2U);
}

TEST_F(Meeting, ABridgeDoesNotContinueTheRoadBelow) {
  for (Station& station : lines_[1].stations) station.position.z() = 6.0;
  joint(End::back, End::front);
  join();
  EXPECT_EQ(lines_.size(), 2U);
}

TEST_F(Meeting, ALineIsJoinedOncePerFrame) {
  lines_.push_back(line(3, straight({-10, 0, 0}, {-1, 0, 0}, 10)));
  joint(End::back, End::front);
  joints_.push_back({markings::end_id(1, End::front), markings::end_id(3, End::back), 10.0, 0.0});
  markings::sort(joints_);
  join();
  EXPECT_EQ(lines_.size(), 2U);
  join();
  ASSERT_EQ(lines_.size(), 1U);
  EXPECT_EQ(lines_[0].stations.size(), 31U);
  EXPECT_TRUE(runs_forth(lines_[0]));
}

TEST_F(Meeting, TheBetterKnownBeliefsStay) {
  lines_[0].beliefs = {.count = 2.0, .mean = 0.7};
  lines_[1].beliefs = {.count = 5.0, .mean = 0.4};
  joint(End::back, End::front);
  join();
  ASSERT_EQ(lines_.size(), 1U);
  EXPECT_EQ(lines_[0].beliefs.mean, 0.4);
}

class Overlapping : public LineJoining {
 protected:
  Overlapping() {
    lines_ = {line(1, straight({0, 0, 0}, {20, 0, 0}, 21)),
              line(2, straight({14, 0.6, 0}, {34, 0.6, 0}, 21))};
  }
  /// A frame that observes the lines where they lie side by side.
  void frame(bool first, bool second) {
    for (Station& station : lines_[0].stations)
      if (station.position.x() > 13.5) station.sight = first ? Sight::observed : Sight::missed;
    for (Station& station : lines_[1].stations)
      if (station.position.x() < 20.5) station.sight = second ? Sight::observed : Sight::missed;
    join();
  }
  void take_turns(int frames = 20) {
    for (int i = 0; i < frames && lines_.size() == 2; ++i) frame(i % 2 == 0, i % 2 != 0);
  }
};

TEST_F(Overlapping, EndsThatTakeTurnsAreJoined) {
  take_turns(3);
  EXPECT_EQ(lines_.size(), 2U);  // too early to tell
  take_turns();
  ASSERT_EQ(lines_.size(), 1U);
  EXPECT_EQ(lines_[0].id, 1U);
  EXPECT_EQ(lines_[0].stations.size(), 35U) << "the older one's stations stay where they overlap";
  EXPECT_TRUE(runs_forth(lines_[0]));
  EXPECT_DOUBLE_EQ(lines_[0].stations.back().position.x(), 34.0);
  ASSERT_EQ(joined_.size(), 1U);
  EXPECT_EQ(joined_[0].gone, 2U);
}

TEST_F(Overlapping, EndsThatAreSeenTogetherStayTwo) {
  for (int i = 0; i < 100; ++i) frame(true, i % 2 == 0);
  EXPECT_EQ(lines_.size(), 2U);
}

TEST_F(Overlapping, AnOverlapThatIsOutOfViewDoesNotTell) {
  for (int i = 0; i < 100; ++i) join();
  EXPECT_EQ(lines_.size(), 2U);
}

TEST_F(Overlapping, LinesThatRunAgainstEachOtherAreJoinedAlike) {
  reverse(lines_[0]);
  take_turns();
  ASSERT_EQ(lines_.size(), 1U);
  EXPECT_EQ(lines_[0].stations.size(), 35U);
  reverse(lines_[0]);
  EXPECT_TRUE(runs_forth(lines_[0])) << "the line still runs as the older one did";
}

TEST_F(Overlapping, LinesTooFarAsideAreNoPair) {
  for (Station& station : lines_[1].stations) station.position.y() = 1.2;
  take_turns();
  EXPECT_EQ(lines_.size(), 2U);
  EXPECT_TRUE(overlaps_.empty());
}

TEST_F(Overlapping, MoreThanAnOverlapIsLeftToTheMergingOfDoubles) {
  lines_[1] = line(2, straight({10, 0.6, 0}, {22, 0.6, 0}, 13));
  take_turns();
  EXPECT_EQ(lines_.size(), 2U);
  EXPECT_TRUE(overlaps_.empty());
}

TEST_F(Overlapping, StoplinesAreNotJoined) {
  for (Line& line : lines_)
    for (Station& station : line.stations) station.type_votes[index(MarkingType::stopline)] = 9.0;
  take_turns();
  EXPECT_EQ(lines_.size(), 2U);
}

TEST_F(Overlapping, ABridgeOverlapsNoRoadBelow) {
  for (Station& station : lines_[1].stations) station.position.z() = 6.0;
  take_turns();
  EXPECT_EQ(lines_.size(), 2U);
}

TEST_F(Overlapping, WhereTheyOverlapTheStationsOfMoreEvidenceStay) {
  for (Station& station : lines_[1].stations) station.log_odds = 3.0;
  for (int i = 0; i < 20 && lines_.size() == 2; ++i) frame(false, true);
  ASSERT_EQ(lines_.size(), 1U);
  EXPECT_EQ(lines_[0].id, 1U);
  EXPECT_TRUE(runs_forth(lines_[0]));
  for (const Station& station : lines_[0].stations)
    EXPECT_DOUBLE_EQ(station.position.y(), station.position.x() < 13.5 ? 0.0 : 0.6);
  EXPECT_DOUBLE_EQ(lines_[0].stations.back().position.x(), 34.0);
}

TEST_F(Overlapping, TheJoinedLineRunsAsTheOlderOneWhicheverIsBetter) {
  reverse(lines_[0]);
  for (Station& station : lines_[1].stations) station.log_odds = 3.0;
  take_turns();
  ASSERT_EQ(lines_.size(), 1U);
  EXPECT_DOUBLE_EQ(lines_[0].stations.front().position.x(), 34.0);
  EXPECT_DOUBLE_EQ(lines_[0].stations.back().position.x(), 0.0);
}

TEST_F(Overlapping, RingsThatOverlapAtBothEndsAreNotJoined) {
  lines_ = {line(1, test::arc({0, 0, 0}, 10.0, 0.0, 220.0)),
            line(2, test::arc({0, 0, 0}, 10.3, 180.0, 400.0))};
  for (int i = 0; i < 20; ++i) {
    for (Line& line : lines_)
      for (Station& station : line.stations)
        station.sight = (i % 2 == 0) == (line.id == 1) ? Sight::observed : Sight::missed;
    join();
  }
  EXPECT_EQ(lines_.size(), 2U);
}

TEST_F(Meeting, ALineIsNotFoldedBackOnItself) {
  // Both lines end where they meet, side by side: a detection along one of them comes near to both ends.
  lines_[1] = line(2, straight({0, -2, 0}, {9.6, 0.9, 0}, 11));
  joint(End::back, End::back);
  join();
  EXPECT_EQ(lines_.size(), 2U);
}

TEST_F(Meeting, ALineThatTurnsOffSharplyStaysTwo) {
  lines_[1] = line(2, straight({10.7, 0.4, 0}, {15.7, 9.06, 0}, 11));
  joint(End::back, End::front);
  join();
  EXPECT_EQ(lines_.size(), 2U);
}

TEST_F(Meeting, OfAShortPieceTheEndThatFacesTheOtherLineIsJoined) {
  lines_ = {line(1, straight({0, 0, 0}, {1, 0, 0}, 2)), line(2, straight({1.3, 0, 0}, {9.3, 0, 0}, 9))};
  joints_ = {{markings::end_id(1, End::front), markings::end_id(2, End::front), 10.0, 0.0},
             {markings::end_id(1, End::back), markings::end_id(2, End::front), 10.0, 0.0}};
  join();
  ASSERT_EQ(lines_.size(), 1U);
  EXPECT_TRUE(runs_forth(lines_[0]));
}

}  // namespace
}  // namespace laneloom::lines
