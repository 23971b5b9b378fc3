#include "mapping/lanes/hypotheses.hpp"

#include <gmock/gmock.h>

#include "mapping/shapes.hpp"

namespace laneloom::lanes {
namespace {

/// Places that say the same, one after another.
std::vector<double> places(std::initializer_list<std::pair<int, double>> stretches) {
  std::vector<double> log_odds;
  for (const auto& [count, each] : stretches)
    log_odds.insert(log_odds.end(), static_cast<std::size_t>(count), each);
  return log_odds;
}

MATCHER_P2(Runs, from, to, "") {
  return arg.begin == static_cast<std::size_t>(from) && arg.end == static_cast<std::size_t>(to);
}

TEST(BestRuns, LieWhereALaneRatherIsThanNot) {
  EXPECT_THAT(best_runs(places({{5, -1}, {10, 1}, {5, -1}})), testing::ElementsAre(Runs(5, 15)));
  EXPECT_THAT(best_runs(places({{10, 1}})), testing::ElementsAre(Runs(0, 10)));
}

TEST(BestRuns, HaveTheSumLessTheCostOfALane) {
  EXPECT_DOUBLE_EQ(best_runs(places({{10, 1}})).front().log_odds, 6.0);
}

TEST(BestRuns, NeedMoreEvidenceThanItTakesToBegin) {
  EXPECT_THAT(best_runs(places({{5, -1}, {3, 1}, {5, -1}})), testing::IsEmpty());
  EXPECT_THAT(best_runs({}), testing::IsEmpty());
}

TEST(BestRuns, BridgeWhatCostsLessThanToBeginAnew) {
  EXPECT_THAT(best_runs(places({{10, 1}, {3, -1}, {10, 1}})), testing::ElementsAre(Runs(0, 23)));
  EXPECT_THAT(best_runs(places({{10, 1}, {6, -1}, {10, 1}})),
              testing::ElementsAre(Runs(0, 10), Runs(16, 26)));
}

TEST(BestRuns, NeverLieWhereAnotherLaneIs) {
  EXPECT_THAT(best_runs(places({{10, 1}, {1, -1e6}, {10, 1}})),
              testing::ElementsAre(Runs(0, 10), Runs(11, 21)));
}

/// The log odds of a lane, or of two, at a place of a street of 7 m. A vehicle drives there, so far from the
/// right edge.
double log_odds_of(Room room, double vehicle_y) {
  boundaries::Boundaries edges;
  for (const double y : {0.0, 7.0})
    edges.insert(
        {test::boundary(y > 0.0 ? 2 : 1, test::straight({0, y, 0}, {20, y, 0}, 21), MarkingType::roadedge)});
  const auto road = boundaries::road_sections(std::move(edges), test::at(5), SectionConfig{});
  const Eigen::Isometry3d vehicle = test::at(10, vehicle_y);
  for (const Hypothesis& one : hypotheses(0, cut_along(0, road, {}), road, {&vehicle, 1}, {}))
    if (one.room == room) return one.log_odds.at(10);
  ADD_FAILURE() << "no hypothesis";
  return 0.0;
}

TEST(Hypotheses, TheVehicleDrivesInOneOfTwoLanesNearerToTheirBorderThanInASingleOne) {
  const double two = log_odds_of(Room::divided, 100.0), one = log_odds_of(Room::between, 100.0);
  EXPECT_GT(log_odds_of(Room::divided, 1.0), two);
  EXPECT_GT(log_odds_of(Room::divided, 6.0), two);
  EXPECT_GT(log_odds_of(Room::divided, 3.5), two) << "drivers keep near the middle of an unmarked street";
  EXPECT_EQ(log_odds_of(Room::divided, 0.5), two);
  EXPECT_EQ(log_odds_of(Room::between, 1.0), one);
  EXPECT_GT(log_odds_of(Room::between, 3.5), one);
}

}  // namespace
}  // namespace laneloom::lanes
