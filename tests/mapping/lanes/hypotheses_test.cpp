#include "mapping/lanes/hypotheses.hpp"

#include <gmock/gmock.h>

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

}  // namespace
}  // namespace laneloom::lanes
