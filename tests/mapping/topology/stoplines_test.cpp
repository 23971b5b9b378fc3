#include "mapping/topology/stoplines.hpp"

#include <gmock/gmock.h>

#include "mapping/shapes.hpp"

namespace laneloom::topology {
namespace {

using test::lane;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

Stopline tie(const Polyline& stopline, const std::vector<Lane>& lanes) {
  return tie_stoplines({test::marking(1, stopline, MarkingType::stopline)}, lanes, {}).at(0);
}

TEST(Stoplines, HoldTheLanesThatEndThere) {
  const Stopline stopline = tie({{21, -3.5, 0}, {21, 3.5, 0}},
                                {lane(7, {0, 1.75, 0}, {20, 1.75, 0}), lane(8, {0, -1.75, 0}, {22, -1.75, 0}),
                                 lane(9, {0, 5.25, 0}, {20, 5.25, 0})});  // beside its end
  EXPECT_THAT(stopline.lanes, ElementsAre(7, 8));
  EXPECT_TRUE(stopline.heading.isApprox(Point(1, 0, 0)));
}

TEST(Stoplines, HeadTowardsTheEndThatTheyLieAt) {
  const Stopline stopline = tie({{-1, 0, 0}, {-1, 3.5, 0}}, {lane(7, {0, 1.75, 0}, {20, 1.75, 0})});
  EXPECT_THAT(stopline.lanes, ElementsAre(7));
  EXPECT_TRUE(stopline.heading.isApprox(Point(-1, 0, 0)));
}

TEST(Stoplines, HoldNothingAtTheStartOfALaneOfKnownDirection) {
  Lane l = lane(7, {0, 1.75, 0}, {20, 1.75, 0});
  l.direction = Lane::Direction::along_centerline;
  EXPECT_THAT(tie({{-1, 0, 0}, {-1, 3.5, 0}}, {l}).lanes, IsEmpty());
  EXPECT_THAT(tie({{21, 0, 0}, {21, 3.5, 0}}, {l}).lanes, ElementsAre(7));
}

TEST(Stoplines, HoldTheLanesThatTheyCrossInTheMiddle) {
  Lane l = lane(7, {0, 0, 0}, {20, 0, 0});
  const Polyline stopline{{10, -2, 0}, {10, 2, 0}};
  EXPECT_THAT(tie(stopline, {l}).lanes, ElementsAre(7));
  EXPECT_EQ(tie(stopline, {l}).heading, Point(0, 0, 0)) << "either way";
  l.direction = Lane::Direction::along_centerline;
  EXPECT_THAT(tie(stopline, {l}).lanes, ElementsAre(7));
  EXPECT_TRUE(tie(stopline, {l}).heading.isApprox(Point(1, 0, 0)));
  EXPECT_THAT(tie({{2, -2, 0}, {2, 2, 0}}, {l}).lanes, IsEmpty()) << "its traffic has passed";
  EXPECT_THAT(tie({{10, -2, 6}, {10, 2, 6}}, {l}).lanes, IsEmpty()) << "on a bridge";
}

TEST(Stoplines, HoldNothingFarAheadBesideOrAlongside) {
  const std::vector<Lane> lanes{lane(7, {0, 0, 0}, {20, 0, 0})};
  EXPECT_THAT(tie({{24, -2, 0}, {24, 2, 0}}, lanes).lanes, IsEmpty());
  EXPECT_THAT(tie({{10, 0.5, 0}, {10, 4, 0}}, lanes).lanes, IsEmpty());
  EXPECT_THAT(tie({{18, -1, 0}, {22, 1, 0}}, lanes).lanes, IsEmpty());
  EXPECT_THAT(tie({{8, -1, 0}, {12, 1, 0}}, lanes).lanes, IsEmpty());
}

TEST(Stoplines, OthersAreNone) {
  EXPECT_THAT(tie_stoplines({test::marking(1, {{0, 0, 0}, {1, 0, 0}})}, {}, {}), IsEmpty());
}

}  // namespace
}  // namespace laneloom::topology
