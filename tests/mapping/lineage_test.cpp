#include "mapping/lineage.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "mapping/shapes.hpp"

namespace laneloom {
namespace {

using Kind = LineageEvent::Kind;
using Element = LineageEvent::Element;
using ::testing::ElementsAre;
using ::testing::FieldsAre;
using ::testing::IsEmpty;

TEST(Lineage, BornAndRetired) {
  EXPECT_THAT(lineage({{1, 1}}, {{2, 2}}, {}),
              ElementsAre(FieldsAre(Kind::retired, Element::boundary, 1, kNoElement),
                          FieldsAre(Kind::born, Element::boundary, 2, kNoElement)));
}

TEST(Lineage, NothingHappened) { EXPECT_THAT(lineage({{1, 1}, {2, 1}}, {{1, 1}, {2, 1}}, {}), IsEmpty()); }

TEST(Lineage, MergedAndSplitAgain) {
  const Membership apart{{1, 1}, {2, 2}}, together{{1, 1}, {2, 1}};
  EXPECT_THAT(lineage(apart, together, {}),
              ElementsAre(FieldsAre(Kind::merged_into, Element::boundary, 2, 1)));
  EXPECT_THAT(lineage(together, apart, {}),
              ElementsAre(FieldsAre(Kind::split_from, Element::boundary, 2, 1)));
}

TEST(Lineage, AMemberOutlivesTheElementThatWasNamedAfterAnOlderOne) {
  EXPECT_THAT(lineage({{1, 1}, {2, 1}}, {{2, 2}}, {}),
              ElementsAre(FieldsAre(Kind::retired, Element::boundary, 1, kNoElement),
                          FieldsAre(Kind::split_from, Element::boundary, 2, 1)));
}

TEST(Lineage, OfALineThatIsCutOffOrMergedItsRelativeTells) {
  EXPECT_THAT(lineage({{1, 1}, {2, 1}}, {{1, 1}, {2, 1}, {5, 5}}, {{5, 2}}),
              ElementsAre(FieldsAre(Kind::split_from, Element::boundary, 5, 1)));
  EXPECT_THAT(lineage({{1, 1}, {3, 3}}, {{1, 1}}, {{3, 1}}),
              ElementsAre(FieldsAre(Kind::merged_into, Element::boundary, 3, 1)));
  EXPECT_THAT(lineage({{1, 1}, {2, 2}, {3, 3}}, {{3, 3}}, {{1, 2}, {2, 3}}),
              ElementsAre(FieldsAre(Kind::merged_into, Element::boundary, 1, 3),
                          FieldsAre(Kind::merged_into, Element::boundary, 2, 3)));
  EXPECT_THAT(lineage({{1, 1}}, {{1, 1}, {5, 5}}, {{5, 4}}),
              ElementsAre(FieldsAre(Kind::born, Element::boundary, 5, kNoElement)));
}

TEST(Lineage, StoplinesAreCalledSo) {
  std::vector<LineageEvent> events = lineage({{1, 1}}, {{1, 1}, {2, 2}, {3, 3}}, {});
  mark_stoplines({{.marking = {.id = 3}}}, events);
  EXPECT_THAT(events, ElementsAre(FieldsAre(Kind::born, Element::boundary, 2, kNoElement),
                                  FieldsAre(Kind::born, Element::stopline, 3, kNoElement)));
}

Lane lane(ElementId id, double from_x, double to_x, double y) {
  return test::lane(id, test::straight({from_x, y, 0}, {to_x, y, 0}, 21));
}

TEST(LaneLineage, ALaneThatLiesNowhereNearIsBornOrRetired) {
  const std::vector<Lane> before{lane(1, 0, 20, 0), lane(2, 0, 20, 3)},
      now{lane(1, 1, 21, 0), lane(3, 0, 20, -3)};
  EXPECT_THAT(lane_lineage(before, now), ElementsAre(FieldsAre(Kind::retired, Element::lane, 2, kNoElement),
                                                     FieldsAre(Kind::born, Element::lane, 3, kNoElement)));
  EXPECT_THAT(lane_lineage(now, now), IsEmpty());
}

TEST(LaneLineage, ANewLaneIsSplitFromTheOneInWhoseStretchItLies) {
  const std::vector<Lane> before{lane(1, 0, 40, 0)};
  EXPECT_THAT(lane_lineage(before, {lane(1, 0, 20, 0), lane(2, 20.5, 40, 0.3)}),
              ElementsAre(FieldsAre(Kind::split_from, Element::lane, 2, 1)));
  EXPECT_THAT(lane_lineage(before, {lane(1, 0, 40, 0), lane(2, 35, 60, 0)}),
              ElementsAre(FieldsAre(Kind::born, Element::lane, 2, kNoElement)))
      << "most of it lies elsewhere";
}

TEST(LaneLineage, ALaneThatAnotherCoversMergedIntoIt) {
  EXPECT_THAT(lane_lineage({lane(1, 0, 20, 0), lane(2, 20, 40, 0)}, {lane(1, 0, 35, 0)}),
              ElementsAre(FieldsAre(Kind::merged_into, Element::lane, 2, 1)));
}

TEST(LaneLineage, ALaneThatIsRenamedMergedIntoItsNewIdWhichIsSplitFromIt) {
  Lane turned = lane(2, 0, 20, 0);
  std::ranges::reverse(turned.centerline);
  EXPECT_THAT(lane_lineage({lane(1, 0, 20, 0)}, {turned}),
              ElementsAre(FieldsAre(Kind::merged_into, Element::lane, 1, 2),
                          FieldsAre(Kind::split_from, Element::lane, 2, 1)));
}

}  // namespace
}  // namespace laneloom
