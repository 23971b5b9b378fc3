#include "mapping/markings/pair_history.hpp"

#include <gmock/gmock.h>

namespace laneloom::markings {
namespace {

using testing::ElementsAre;
using testing::Pair;

/// The pairs of the histories, each with the frames that saw it.
std::vector<std::pair<std::pair<ElementId, ElementId>, double>> frames_of(const PairHistories& histories) {
  std::vector<std::pair<std::pair<ElementId, ElementId>, double>> result;
  for (const PairHistory& h : histories) result.push_back({{h.a, h.b}, h.together + h.apart});
  return result;
}

TEST(PairHistory, OfARenamedIdIsThatOfTheOtherId) {
  PairHistories histories{{1, 7, 2.0, 0.0}, {3, 5, 1.0, 0.0}, {5, 9, 0.0, 4.0}};
  rename(5, 2, histories);
  EXPECT_THAT(frames_of(histories),
              ElementsAre(Pair(Pair(1, 7), 2.0), Pair(Pair(2, 3), 1.0), Pair(Pair(2, 9), 4.0)));
  ASSERT_NE(find(histories, 9, 2), nullptr);
  EXPECT_DOUBLE_EQ(find(histories, 9, 2)->apart, 4.0);
}

TEST(PairHistory, OfTwoThatBecomeOneTheLongerOneStays) {
  PairHistories histories{{1, 3, 2.0, 3.0}, {1, 5, 6.0, 0.0}, {3, 4, 9.0, 0.0}, {4, 5, 1.0, 1.0}};
  rename(5, 3, histories);
  EXPECT_THAT(frames_of(histories), ElementsAre(Pair(Pair(1, 3), 6.0), Pair(Pair(3, 4), 9.0)));
}

TEST(PairHistory, OfTheTwoWithEachOtherIsForgotten) {
  PairHistories histories{{3, 5, 2.0, 3.0}};
  rename(5, 3, histories);
  EXPECT_TRUE(histories.empty());
}

TEST(PairHistory, OfAForgottenIdNothingIsLeft) {
  PairHistories histories{{1, 3, 2.0, 3.0}, {1, 5, 6.0, 0.0}, {3, 5, 1.0, 0.0}};
  forget(3, histories);
  EXPECT_THAT(frames_of(histories), ElementsAre(Pair(Pair(1, 5), 6.0)));
}

}  // namespace
}  // namespace laneloom::markings
