#include "mapping/topology/driven_linkages.hpp"

#include <gmock/gmock.h>

#include "mapping/shapes.hpp"

namespace laneloom::topology {
namespace {

using test::lane;
using ::testing::IsEmpty;
using Kind = Linkage::Kind;

/// Lane 1 leads east to an intersection; 2 goes on straight, 3 to the left, 4 lies beside 1.
class TrafficLinkages : public ::testing::Test {
 protected:
  TrafficLinkages() {
    road_.lanes = {lane(1, {0, 0, 0}, {20, 0, 0}), lane(2, {40, 0, 0}, {60, 0, 0}),
                   lane(3, {30, 10, 0}, {30, 30, 0}), lane(4, {0, 3.5, 0}, {20, 3.5, 0})};
    road_.lanes[0].left_neighbours = {{.lane = 4, .range = {0.0, 20.0}}};
    road_.lanes[3].right_neighbours = {{.lane = 1, .range = {0.0, 20.0}}};
  }

  /// The linkages after a vehicle drove along a line.
  const std::vector<Linkage>& drive(const Polyline& line) {
    return drive_through(MeasuredPolyline(line).resample(1.0));
  }
  /// Likewise, at the places of its trail.
  const std::vector<Linkage>& drive_through(const Polyline& places) {
    const std::vector<trails::Trail> trails{{.session = 1, .object = 1, .points = places}};
    link_traffic(trails, driven_stretches(trails, road_.lanes), road_);
    return road_.linkages;
  }

  RoadGraph road_;
};

const Polyline kTurn{{4, 0, 0}, {20, 0, 0}, {27, 3, 0}, {30, 10, 0}, {30, 25, 0}};

TEST_F(TrafficLinkages, LeadWhereOneVehicleDrove) {
  const std::vector<Linkage>& linkages = drive(kTurn);
  ASSERT_EQ(linkages.size(), 1U);
  EXPECT_EQ(linkages[0].from, 1U);
  EXPECT_EQ(linkages[0].to, 3U);
  EXPECT_EQ(linkages[0].kind, Kind::traffic);
  EXPECT_EQ(linkages[0].turn, Linkage::Turn::left);
  EXPECT_EQ(linkages[0].evidence, Evidence::traffic);
  EXPECT_TRUE(linkages[0].path.front().isApprox(Point(20, 0, 0)));
  EXPECT_TRUE(linkages[0].path.back().isApprox(Point(30, 10, 0)));
}

TEST_F(TrafficLinkages, LeadNowhereAgainstTheLanes) {
  EXPECT_THAT(drive({kTurn.rbegin(), kTurn.rend()}), IsEmpty());
  std::ranges::reverse(road_.lanes[2].centerline);
  EXPECT_THAT(drive(kTurn), IsEmpty());
}

TEST_F(TrafficLinkages, AChangeOfLanesIsNone) {
  EXPECT_THAT(drive({{2, 0, 0}, {8, 0, 0}, {14, 3.5, 0}, {20, 3.5, 0}}), IsEmpty());
}

TEST_F(TrafficLinkages, WhoLeavesALaneBeforeItsEndMayPark) {
  EXPECT_THAT(drive({{2, 0, 0}, {10, 0, 0}, {14, -8, 0}, {30, -6, 0}, {30, 25, 0}}), IsEmpty());
}

TEST_F(TrafficLinkages, WhoComesIntoALaneBehindItsStartMayComeFromAYard) {
  EXPECT_THAT(drive({{4, 0, 0}, {20, 0, 0}, {25, 14, 0}, {30, 20, 0}, {30, 29, 0}}), IsEmpty());
}

TEST_F(TrafficLinkages, AVehicleThatWasOutOfSightTellsNothing) {
  Polyline places;
  for (double x = 10.0; x <= 20.0; x += 1.0) places.emplace_back(x, 0.0, 0.0);
  Polyline seen_again = places;
  for (double x = 40.0; x <= 50.0; x += 1.0) seen_again.emplace_back(x, 0.0, 0.0);
  EXPECT_THAT(drive_through(seen_again), IsEmpty());
  for (double x = 21.0; x <= 50.0; x += 1.0) places.emplace_back(x, 0.0, 0.0);
  EXPECT_EQ(drive_through(places).size(), 1U);
}

TEST_F(TrafficLinkages, ConfirmAHypothesisAndLeaveWhatIsSurer) {
  const Linkage guess{.from = 1,
                      .to = 3,
                      .kind = Kind::intersection,
                      .turn = Linkage::Turn::left,
                      .probability = 0.6,
                      .evidence = Evidence::markings,
                      .path = {{20, 0, 0}, {30, 10, 0}}};
  road_.linkages = {guess};
  ASSERT_EQ(drive(kTurn).size(), 1U);
  EXPECT_EQ(road_.linkages[0].kind, Kind::traffic);
  EXPECT_GT(road_.linkages[0].probability, 0.6);
  EXPECT_EQ(road_.linkages[0].evidence, Evidence::markings | Evidence::traffic);
  for (const Kind kind : {Kind::shared_boundary, Kind::sd_map, Kind::ego_track}) {
    road_.linkages = {guess};
    road_.linkages[0].kind = kind;
    ASSERT_EQ(drive(kTurn).size(), 1U);
    EXPECT_EQ(road_.linkages[0].kind, kind);
    EXPECT_EQ(road_.linkages[0].probability, 0.6);
    EXPECT_EQ(road_.linkages[0].evidence, Evidence::markings | Evidence::traffic);
  }
}

TEST_F(TrafficLinkages, TheOwnDriveIsSurerThanOthers) {
  const double of_others = drive(kTurn).at(0).probability;
  link_driven({{1, 3}}, Driver::ego, road_);
  ASSERT_EQ(road_.linkages.size(), 1U);
  EXPECT_EQ(road_.linkages[0].kind, Kind::ego_track);
  EXPECT_GT(road_.linkages[0].probability, of_others);
  EXPECT_EQ(road_.linkages[0].evidence, Evidence::traffic | Evidence::ego_path);
  drive(kTurn);
  EXPECT_EQ(road_.linkages[0].kind, Kind::ego_track) << "others change nothing any more";
}

}  // namespace
}  // namespace laneloom::topology
