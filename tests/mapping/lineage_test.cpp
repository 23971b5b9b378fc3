#include "mapping/lineage.hpp"

#include <gmock/gmock.h>

namespace laneloom {
namespace {

using Kind = LineageEvent::Kind;
using ::testing::ElementsAre;
using ::testing::FieldsAre;
using ::testing::IsEmpty;

TEST(Lineage, BornAndRetired) {
  EXPECT_THAT(lineage({{1, 1}}, {{2, 2}}, {}),
              ElementsAre(FieldsAre(Kind::retired, 1, kNoElement), FieldsAre(Kind::born, 2, kNoElement)));
}

TEST(Lineage, NothingHappened) { EXPECT_THAT(lineage({{1, 1}, {2, 1}}, {{1, 1}, {2, 1}}, {}), IsEmpty()); }

TEST(Lineage, MergedAndSplitAgain) {
  const Membership apart{{1, 1}, {2, 2}}, together{{1, 1}, {2, 1}};
  EXPECT_THAT(lineage(apart, together, {}), ElementsAre(FieldsAre(Kind::merged_into, 2, 1)));
  EXPECT_THAT(lineage(together, apart, {}), ElementsAre(FieldsAre(Kind::split_from, 2, 1)));
}

TEST(Lineage, AMemberOutlivesTheElementThatWasNamedAfterAnOlderOne) {
  EXPECT_THAT(lineage({{1, 1}, {2, 1}}, {{2, 2}}, {}),
              ElementsAre(FieldsAre(Kind::retired, 1, kNoElement), FieldsAre(Kind::split_from, 2, 1)));
}

TEST(Lineage, OfALineThatIsCutOffOrMergedItsRelativeTells) {
  EXPECT_THAT(lineage({{1, 1}, {2, 1}}, {{1, 1}, {2, 1}, {5, 5}}, {{5, 2}}),
              ElementsAre(FieldsAre(Kind::split_from, 5, 1)));
  EXPECT_THAT(lineage({{1, 1}, {3, 3}}, {{1, 1}}, {{3, 1}}), ElementsAre(FieldsAre(Kind::merged_into, 3, 1)));
  EXPECT_THAT(lineage({{1, 1}, {2, 2}, {3, 3}}, {{3, 3}}, {{1, 2}, {2, 3}}),
              ElementsAre(FieldsAre(Kind::merged_into, 1, 3), FieldsAre(Kind::merged_into, 2, 3)));
  EXPECT_THAT(lineage({{1, 1}}, {{1, 1}, {5, 5}}, {{5, 4}}),
              ElementsAre(FieldsAre(Kind::born, 5, kNoElement)));
}

}  // namespace
}  // namespace laneloom
