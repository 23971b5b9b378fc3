#include "mapping/lines/association.hpp"

#include <gmock/gmock.h>

#include "mapping/shapes.hpp"

namespace laneloom::lines {
namespace {

using test::line;
using test::straight;

std::vector<SampledDetection> detect(const std::vector<Polyline>& lines,
                                     MarkingType type = MarkingType::laneline) {
  std::vector<markings::ObservedMarking> markings;
  for (const Polyline& points : lines) markings.push_back({type, MarkingStyle::unknown, 0.9, points});
  return sample_detections(markings, {});
}

std::vector<std::pair<std::size_t, std::size_t>> matched(const std::vector<Line>& lines,
                                                         const std::vector<SampledDetection>& detections) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (const LineMatch& match : LineMatcher(lines, {}).match(detections))
    pairs.emplace_back(match.detection, match.line);
  std::ranges::sort(pairs);
  return pairs;
}

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;
using ::testing::SizeIs;

TEST(Association, ADetectionObservesTheLineThatItLiesOn) {
  const std::vector<Line> lines{line(1, straight({0, 0, 0}, {30, 0, 0}, 31)),
                                line(2, straight({0, 3.5, 0}, {30, 3.5, 0}, 31))};
  EXPECT_THAT(
      matched(lines, detect({straight({5, 3.3, 0}, {25, 3.6, 0}), straight({40, 0.2, 0}, {10, -0.2, 0})})),
      ElementsAre(Pair(0, 1), Pair(1, 0)));
}

TEST(Association, NotTooFarNorAcrossNorOnAnotherLevel) {
  const std::vector<Line> lines{line(1, straight({0, 0, 0}, {30, 0, 0}, 31))};
  EXPECT_THAT(matched(lines, detect({straight({0, 0.7, 0}, {30, 0.7, 0})})), IsEmpty());
  EXPECT_THAT(matched(lines, detect({straight({10, -4, 0}, {15, 4, 0})})), IsEmpty());
  EXPECT_THAT(matched(lines, detect({straight({0, 0, 6}, {30, 0, 6})})), IsEmpty());
}

TEST(Association, NotWithLittleInCommon) {
  const std::vector<Line> lines{line(1, straight({0, 0, 0}, {30, 0, 0}, 31))};
  EXPECT_THAT(matched(lines, detect({straight({0, 0, 0}, {1.5, 0, 0})})), IsEmpty());
  EXPECT_THAT(matched(lines, detect({straight({0, 0, 0}, {2.2, 0, 0})})), SizeIs(1));
  EXPECT_THAT(matched(lines, detect({straight({-20, 0, 0}, {1, 0, 0})})), IsEmpty());
  EXPECT_THAT(matched(lines, detect({straight({-20, 0, 0}, {2, 0, 0})})), SizeIs(1));
}

TEST(Association, LanelinesAndRoadedgesMayBeTheSameLineStoplinesNot) {
  const std::vector<Line> lines{line(1, straight({0, 0, 0}, {10, 0, 0}, 11))};
  EXPECT_EQ(matched(lines, detect({straight({0, 0, 0}, {10, 0, 0})}, MarkingType::roadedge)).size(), 1U);
  EXPECT_THAT(matched(lines, detect({straight({0, 0, 0}, {10, 0, 0})}, MarkingType::stopline)), IsEmpty());
}

TEST(Association, WhatIsSeenSideBySideIsNotOneLine) {
  // A double line, 0.24 m apart, seen with a common offset.
  const std::vector<Line> lines{line(1, straight({0, 0.12, 0}, {30, 0.12, 0}, 31)),
                                line(2, straight({0, -0.12, 0}, {30, -0.12, 0}, 31))};
  const auto pairs = matched(
      lines, detect({straight({0, 0.17, 0}, {30, 0.17, 0}), straight({0, -0.07, 0}, {30, -0.07, 0})}));
  EXPECT_THAT(pairs, ElementsAre(Pair(0, 0), Pair(1, 1)));
  // A third one beside them observes neither.
  EXPECT_EQ(
      matched(lines, detect({straight({0, 0.12, 0}, {30, 0.12, 0}), straight({0, -0.12, 0}, {30, -0.12, 0}),
                             straight({0, 0.3, 0}, {30, 0.3, 0})}))
          .size(),
      2U);
}

TEST(Association, ConfirmedPiecesWinAgainstALongLineThatIsNotConfirmed) {
  std::vector<Line> lines{line(1, straight({0, 0, 0}, {14, 0, 0}, 15)),
                          line(2, straight({16, 0, 0}, {30, 0, 0}, 15)),
                          line(3, straight({0, 0.4, 0}, {30, 0.4, 0}, 31))};
  const auto detections = detect({straight({0, 0.2, 0}, {30, 0.2, 0})});
  EXPECT_THAT(matched(lines, detections), ElementsAre(Pair(0, 2))) << "none is confirmed";
  for (std::size_t i : {0U, 1U})
    for (Station& station : lines[i].stations) station.log_odds = 5.0;
  EXPECT_THAT(matched(lines, detections), ElementsAre(Pair(0, 0), Pair(0, 1)));
  // At 0.5 m the confirmed lines do not fit well.
  EXPECT_THAT(matched(lines, detect({straight({0, 0.5, 0}, {30, 0.5, 0})})), ElementsAre(Pair(0, 2)));
}

TEST(Association, OneDetectionMayObserveTwoLinesInARow) {
  const std::vector<Line> lines{line(1, straight({0, 0, 0}, {10, 0, 0}, 11)),
                                line(2, straight({14, 0, 0}, {30, 0, 0}, 17))};
  LineMatcher matcher(lines, {});
  const Association found = associate(matcher, detect({straight({0, 0.1, 0}, {30, 0.1, 0})}));
  EXPECT_EQ(found.matches.size(), 2U);
  const auto unexplained = std::ranges::count(found.detections[0].explained, false);
  EXPECT_EQ(unexplained, 3);  // in the gap of 4 m, less half a spacing at each end
}

}  // namespace
}  // namespace laneloom::lines
