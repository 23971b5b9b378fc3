#include "mapping/boundaries/lane_boundaries.hpp"

#include <gmock/gmock.h>

#include "mapping/shapes.hpp"

namespace laneloom::boundaries {
namespace {

using test::marking;
using test::straight;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(LaneBoundaries, JoinsCloseAlignedEndsUnderTheOldestId) {
  const auto boundaries = lane_boundaries(
      {marking(4, straight({13, 0.2, 0}, {20, 0.2, 0})), marking(7, straight({0, 0, 0}, {10, 0, 0}))}, {},
      {});
  ASSERT_EQ(boundaries.size(), 1U);
  EXPECT_EQ(boundaries[0].marking.id, 4U);
  EXPECT_THAT(boundaries[0].members, ElementsAre(4, 7));
  EXPECT_EQ(boundaries[0].marking.points.size(), 4U);
  EXPECT_NEAR(length(boundaries[0].marking.points), 20.0, 0.01);
}

TEST(LaneBoundaries, JoinsWhateverTheirDirections) {
  const Polyline a = straight({0, 0, 0}, {10, 0, 0}), b = straight({20, 0, 0}, {12, 0, 0}),
                 c = straight({22, 0, 0}, {30, 0, 0});
  const auto boundaries = lane_boundaries({marking(1, a), marking(2, b), marking(3, c)}, {}, {});
  ASSERT_EQ(boundaries.size(), 1U);
  EXPECT_DOUBLE_EQ(length(boundaries[0].marking.points), 30.0);
  EXPECT_EQ(boundaries[0].marking.points.front(), Point(0, 0, 0));
}

TEST(LaneBoundaries, LeavesApartWhatIsNotOneLine) {
  const Marking line = marking(1, straight({0, 0, 0}, {10, 0, 0}));
  const auto count = [&](const Marking& other) { return lane_boundaries({line, other}, {}, {}).size(); };
  EXPECT_EQ(count(marking(2, straight({16, 0, 0}, {20, 0, 0}))), 2U);  // too far
  EXPECT_EQ(count(marking(2, straight({12, 1, 0}, {20, 1, 0}))), 2U);  // beside
  EXPECT_EQ(count(marking(2, straight({12, 0, 0}, {15, 3, 0}))), 2U);  // turning off
  // The extension of the one meets the other, and the extension of the other passes by: no id decides.
  const Polyline askew = straight({14.9, 0, 0}, {24.3, 3.3, 0});
  EXPECT_EQ(count(marking(2, askew)), 2U);
  EXPECT_EQ(lane_boundaries({marking(1, askew), marking(2, line.points)}, {}, {}).size(), 2U);
  EXPECT_EQ(count(marking(2, straight({12, 0, 0}, {20, 0, 0}), MarkingType::roadedge)), 2U);  // another type
  EXPECT_EQ(count(marking(2, straight({12, 0, 6}, {20, 0, 6}))), 2U);                         // on a bridge
  EXPECT_EQ(count(marking(2, straight({12, 0, 0}, {20, 0, 0}))), 1U);
}

TEST(LaneBoundaries, EndsThatDetectionsRanThroughAreOneAtAnyAngle) {
  const std::vector<Marking> sides{marking(1, straight({0, 0, 0}, {10, 0, 0}), MarkingType::roadedge),
                                   marking(2, straight({0, 1.5, 0}, {10, 1.5, 0}), MarkingType::roadedge)};
  const auto count = [&](double together, double apart) {
    const markings::PairHistory tip{markings::end_id(1, End::back), markings::end_id(2, End::back), together,
                                    apart};
    return lane_boundaries(sides, {tip}, {}).size();
  };
  EXPECT_EQ(count(0.0, 0.0), 2U);
  EXPECT_EQ(count(3.0, 1.0), 1U);
  EXPECT_EQ(count(3.0, 5.0), 2U);
}

TEST(LaneBoundaries, FollowACornerWhereTheEndsMeet) {
  const Point centre(10, 8, 0);
  const auto pieces = [&](double gap_deg) {
    return lane_boundaries({marking(1, test::arc(centre, 8, -90, -45)),
                            marking(2, test::arc(centre, 8, -45 + gap_deg, 0))},
                           {}, {})
        .size();
  };
  EXPECT_EQ(pieces(4), 1U);
  EXPECT_EQ(pieces(20), 2U) << "too much of it is not seen";
  const Marking line = marking(1, straight({0, 0, 0}, {10, 0, 0}));
  EXPECT_EQ(lane_boundaries({line, marking(2, straight({10, 0, 0}, {15, 5, 0}))}, {}, {}).size(), 2U)
      << "a branch";
}

TEST(LaneBoundaries, WhatIsKnownToBeSeparateStaysApart) {
  const std::vector<Marking> pieces{marking(4, straight({12, 0, 0}, {20, 0, 0})),
                                    marking(7, straight({0, 0, 0}, {10, 0, 0}))};
  EXPECT_EQ(
      lane_boundaries(
          pieces,
          {{.a = markings::end_id(4, End::front), .b = markings::end_id(7, End::back), .apart = 10.0}}, {})
          .size(),
      2U);
  EXPECT_EQ(lane_boundaries(pieces,
                            {{.a = markings::end_id(4, End::front),
                              .b = markings::end_id(7, End::back),
                              .together = 10.0,
                              .apart = 10.0}},
                            {})
                .size(),
            1U);
}

TEST(LaneBoundaries, KnowTheGapsThatTheyBridge) {
  auto boundaries = lane_boundaries(
      {marking(1, straight({0, 0, 0}, {10, 0, 0})), marking(2, straight({12, 0, 0}, {20, 0, 0})),
       marking(3, straight({20.5, 0, 0}, {30, 0, 0}))},
      {}, {});
  ASSERT_EQ(boundaries.size(), 1U);
  ASSERT_EQ(boundaries[0].bridged.size(), 1U);
  EXPECT_NEAR(boundaries[0].bridged[0].from_m, 10.0, 1e-9);
  EXPECT_NEAR(boundaries[0].bridged[0].to_m, 12.0, 1e-9);
  boundaries.reverse(0);
  EXPECT_NEAR(boundaries[0].bridged[0].from_m, 18.0, 1e-9);
  EXPECT_NEAR(boundaries[0].bridged[0].to_m, 20.0, 1e-9);
}

TEST(LaneBoundaries, EachEndIsJoinedOnceToTheNearest) {
  // A fork: the straight continuation is nearer than the one that is set off.
  const auto boundaries = lane_boundaries(
      {marking(1, straight({0, 0, 0}, {10, 0, 0})), marking(2, straight({13, 0.7, 0}, {20, 0.7, 0})),
       marking(3, straight({12, 0, 0}, {20, 0, 0}))},
      {}, {});
  ASSERT_EQ(boundaries.size(), 2U);
  EXPECT_THAT(boundaries[0].members, ElementsAre(1, 3));
}

TEST(LaneBoundaries, OverlappingEndsDoNotRunBack) {
  const Marking line = marking(1, straight({0, 0, 0}, {10, 0, 0}, 6));
  for (const Polyline& next :
       {straight({9, 0.1, 0}, {20, 0.1, 0}, 12), straight({9, 0.1, 0}, {20, 0.1, 0}, 2),
        straight({9.2, 0.1, 0}, {10.4, 0.1, 0}, 2), straight({6, 0.1, 0}, {9, 0.1, 0}, 4)}) {
    const auto boundaries = lane_boundaries({line, marking(2, next)}, {}, {});
    ASSERT_EQ(boundaries.size(), 1U);
    EXPECT_THAT(boundaries[0].bridged, IsEmpty());
    const auto& points = boundaries[0].marking.points;
    for (std::size_t i = 1; i < points.size(); ++i) EXPECT_GT(points[i].x(), points[i - 1].x());
  }
}

TEST(LaneBoundaries, ARingOfPiecesStaysOpen) {
  std::vector<Marking> pieces;
  for (int k = 0; k < 4; ++k) {
    pieces.push_back(
        marking(static_cast<ElementId>(k + 1), test::arc({0, 0, 0}, 12, 90 * k + 1, 90 * k + 89)));
  }
  const auto boundaries = lane_boundaries(pieces, {}, {});
  ASSERT_EQ(boundaries.size(), 1U);
  EXPECT_THAT(boundaries[0].members, ElementsAre(1, 2, 3, 4));
}

TEST(LaneBoundaries, StoplinesAreNone) {
  EXPECT_TRUE(
      lane_boundaries({marking(1, straight({0, 0, 0}, {0, 4, 0}), MarkingType::stopline)}, {}, {}).empty());
}

}  // namespace
}  // namespace laneloom::boundaries
