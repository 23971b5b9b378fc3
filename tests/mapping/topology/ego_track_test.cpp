#include "mapping/topology/ego_track.hpp"

#include <gmock/gmock.h>

#include "mapping/shapes.hpp"

namespace laneloom::topology {
namespace {

using test::lane;
using test::straight;
using ::testing::IsEmpty;

/// Lane 1 leads east to an intersection; 2 goes on straight, 3 to the left, 4 lies beside 1.
class EgoTrackTest : public ::testing::Test {
 protected:
  EgoTrackTest()
      : lanes_{lane(1, {0, 0, 0}, {20, 0, 0}), lane(2, {40, 0, 0}, {60, 0, 0}),
               lane(3, {30, 10, 0}, {30, 30, 0}), lane(4, {0, 3.5, 0}, {20, 3.5, 0})} {
    lanes_[0].left_neighbours = {{.lane = 4, .range = {0.0, 20.0}}};
  }
  std::vector<Linkage> drive(double x, double y, double yaw_rad = 0.0, std::vector<Linkage> known = {}) {
    RoadGraph road{{{}, lanes_}, std::move(known)};
    link_ego_track(test::at(x, y, yaw_rad), track_, road);
    return road.linkages;
  }
  std::vector<Lane> lanes_;
  EgoTrack track_;
};

constexpr double kNorth = std::numbers::pi / 2;

TEST_F(EgoTrackTest, AWayThatWasDrivenIsALinkage) {
  drive(10, 0);
  EXPECT_THAT(drive(25, 3, kNorth / 2), IsEmpty());  // in no lane
  const auto linkages = drive(30, 12, kNorth);
  ASSERT_EQ(linkages.size(), 1U);
  EXPECT_EQ(linkages[0].from, 1U);
  EXPECT_EQ(linkages[0].to, 3U);
  EXPECT_EQ(linkages[0].kind, Linkage::Kind::ego_track);
  EXPECT_EQ(linkages[0].turn, Linkage::Turn::left);
  EXPECT_TRUE(linkages[0].path.front().isApprox(Point(20, 0, 0)));
  EXPECT_TRUE(linkages[0].path.back().isApprox(Point(30, 10, 0)));
}

TEST_F(EgoTrackTest, ItConfirmsAHypothesis) {
  const std::vector<Linkage> guess{{.from = 1,
                                    .to = 2,
                                    .kind = Linkage::Kind::intersection,
                                    .probability = 0.6,
                                    .path = {{20, 0, 0}, {40, 0, 0}}}};
  EXPECT_EQ(drive(10, 0, 0.0, guess)[0].kind, Linkage::Kind::intersection);
  const auto linkages = drive(45, 0, 0.0, guess);
  ASSERT_EQ(linkages.size(), 1U);
  EXPECT_EQ(linkages[0].kind, Linkage::Kind::ego_track);
  EXPECT_GT(linkages[0].probability, 0.9);
  EXPECT_TRUE(overlap(linkages[0].evidence, Evidence::ego_path));
}

TEST_F(EgoTrackTest, ChangingLanesIsNone) {
  drive(10, 0);
  EXPECT_THAT(drive(15, 3.5), IsEmpty());
}

TEST_F(EgoTrackTest, CrossingALaneOrDrivingAgainstItIsNone) {
  drive(10, 0);
  EXPECT_THAT(drive(50, 0, kNorth), IsEmpty());
  EXPECT_THAT(drive(50, 0, 2 * kNorth), IsEmpty());
}

TEST_F(EgoTrackTest, WhereLanesMeetTheOneBehindWasNotDrivenInto) {
  drive(1, 0);
  lanes_[0] = lane(1, {2, 0, 0}, {20, 0, 0});
  lanes_.push_back(lane(5, {-20, 0, 0}, {2, 0, 0}));
  EXPECT_THAT(drive(1.5, 0), IsEmpty());
  const auto linkages = drive(3, 0);
  ASSERT_EQ(linkages.size(), 1U);
  EXPECT_THAT(linkages[0].path, IsEmpty());
}

TEST_F(EgoTrackTest, AUTurnHasAPathBesideTheEndOfTheLane) {
  drive(10, 0);
  lanes_ = {lane(1, {0, 0, 0}, {20, 0, 0}), lane(5, {20, 7, 0}, {0, 7, 0})};
  const auto linkages = drive(15, 7, 2 * kNorth);
  ASSERT_EQ(linkages.size(), 1U);
  ASSERT_GE(linkages[0].path.size(), 2U);
  EXPECT_TRUE(linkages[0].path.back().isApprox(Point(20, 7, 0)));
}

TEST_F(EgoTrackTest, BackAndForthAtAPlaceIsOneStep) {
  lanes_ = {lane(1, {0, 0, 0}, {20, 0, 0}), lane(2, {19, 0, 0}, {40, 0, 0})};
  for (int i = 0; i < 10; ++i) {
    drive(18, 0);
    drive(21, 0);
  }
  EXPECT_THAT(track_.steps, testing::ElementsAre(LaneStep(1, 2)));
}

TEST_F(EgoTrackTest, ItStaysInALaneForAsLongAsThatIsThere) {
  drive(10, 0);
  lanes_.insert(lanes_.begin(), lane(5, {8, 0.5, 0}, {40, 0.5, 0}));
  EXPECT_THAT(drive(12, 0), IsEmpty());
}

TEST_F(EgoTrackTest, ItEndsWithItsLanes) {
  drive(10, 0);
  ASSERT_EQ(drive(45, 0).size(), 1U);
  lanes_.erase(lanes_.begin());
  EXPECT_THAT(drive(46, 0), IsEmpty());
  EXPECT_TRUE(track_.steps.empty());
}

}  // namespace
}  // namespace laneloom::topology
