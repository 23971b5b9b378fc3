#include "evaluation/evaluation.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "straight_lines.hpp"

namespace laneloom {
namespace {

evaluation::MapScore score(const std::vector<evaluation::KindLine>& truth,
                           const std::vector<evaluation::KindLine>& predictions,
                           const Eigen::Isometry3d& T_map_body = Eigen::Isometry3d::Identity()) {
  evaluation::MapScore result;
  add(evaluation::compare(truth, predictions, T_map_body, kRange), result);
  return result;
}

TEST(Clip, CutsAtTheBox) {
  const auto pieces = evaluation::clip({{-10, 2, 1}, {10, 2, 1}, {40, 2, 1}}, kRange);
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_TRUE(pieces[0].front().isApprox(Point(-5, 2, 1)));
  EXPECT_TRUE(pieces[0].back().isApprox(Point(30, 2, 1)));
  EXPECT_EQ(pieces[0].size(), 3u);
}

TEST(Clip, MakesSeveralLinesOfOneThatComesBack) {
  const auto pieces = evaluation::clip({{0, 14, 0}, {4, 18, 0}, {8, 14, 0}}, kRange);
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_TRUE(pieces[0].back().isApprox(Point(1, 15, 0)));
  EXPECT_TRUE(pieces[1].front().isApprox(Point(7, 15, 0)));
}

TEST(Clip, KeepsALineThatOnlyCrosses) {
  const auto pieces = evaluation::clip({{10, -20, 0}, {10, 20, 0}}, kRange);
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_TRUE(pieces[0].front().isApprox(Point(10, -15, 0)));
}

TEST(Clip, JoinsARingAtItsSeam) {
  const Polyline ring{{0, 12, 0}, {5, 12, 0}, {5, 20, 0}, {-2, 20, 0}, {-2, 12, 0}, {0, 12, 0}};
  const auto pieces = evaluation::clip(ring, kRange);
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_TRUE(pieces[0].front().isApprox(Point(-2, 15, 0)));
  EXPECT_TRUE(pieces[0].back().isApprox(Point(5, 15, 0)));
  EXPECT_EQ(pieces[0].size(), 5u);
  EXPECT_EQ(evaluation::clip({{0, 0, 0}, {5, 0, 0}, {5, 5, 0}, {0, 0, 0}}, kRange).size(),
            1u);  // wholly inside
}

TEST(Clip, LeavesOutWhatIsShorterThanAMetreOrOutside) {
  EXPECT_TRUE(evaluation::clip({{29.1, 0, 0}, {40, 0, 0}}, kRange).empty());
  EXPECT_EQ(evaluation::clip({{28.9, 0, 0}, {40, 0, 0}}, kRange).size(), 1u);
  EXPECT_TRUE(evaluation::clip({{0, 16, 0}, {20, 16, 0}}, kRange).empty());
  EXPECT_TRUE(evaluation::clip({}, kRange).empty());
  EXPECT_TRUE(evaluation::clip({{0, 0, 0}}, kRange).empty());
}

TEST(Clip, LeavesOutTheRoadOnAnotherLevel) {
  EXPECT_TRUE(evaluation::clip({{0, 0, -6}, {20, 0, -6}}, kRange).empty());
}

TEST(Evaluation, APerfectMapScoresPerfectly) {
  const std::vector<evaluation::KindLine> truth{straight(0, -20, 60),
                                                straight(3, -20, 60, evaluation::LineKind::roadedge),
                                                {evaluation::LineKind::stopline, {{20, 0, 0}, {20, 3, 0}}},
                                                straight(1.5, 0, 20, evaluation::LineKind::lane)};
  const evaluation::MapScore perfect = score(truth, truth);
  for (const evaluation::Score& kind : perfect.by_kind) {
    EXPECT_EQ(kind.matches, 1u);
    EXPECT_DOUBLE_EQ(kind.precision(), 1.0);
    EXPECT_DOUBLE_EQ(kind.recall(), 1.0);
    EXPECT_DOUBLE_EQ(kind.f1(), 1.0);
    EXPECT_DOUBLE_EQ(kind.acd_m(), 0.0);
  }
  EXPECT_EQ(perfect.markings().truths, 3u);  // without the lane
}

TEST(Evaluation, AnOffsetBelowHalfAMetreMatchesWithThatDistance) {
  const evaluation::MapScore near = score({straight(0, 0, 20)}, {straight(0.25, 0, 20)});
  EXPECT_EQ(near.of(evaluation::LineKind::laneline).matches, 1u);
  EXPECT_NEAR(near.of(evaluation::LineKind::laneline).acd_m(), 0.25, 1e-9);
  EXPECT_EQ(score({straight(0, 0, 20)}, {straight(0.5, 0, 20)}).of(evaluation::LineKind::laneline).matches,
            0u);
}

TEST(Evaluation, AHeightDifferenceIsNoDistance) {
  const evaluation::KindLine lifted{evaluation::LineKind::laneline, {{0, 0, 0.4}, {20, 0, 0.4}}};
  EXPECT_DOUBLE_EQ(score({straight(0, 0, 20)}, {lifted}).of(evaluation::LineKind::laneline).acd_m(), 0.0);
}

TEST(Evaluation, NeedsMoreThanThreeQuartersOfTheTruthsSamples) {
  // Truth: 20 m are 201 samples, 75 % of them 150.75. A prediction of 15 m has 151, one of 14.9 m 150.
  EXPECT_EQ(score({straight(0, 0, 20)}, {straight(0, 0, 15)}).of(evaluation::LineKind::laneline).matches, 1u);
  EXPECT_EQ(score({straight(0, 0, 20)}, {straight(0, 0, 14.9)}).of(evaluation::LineKind::laneline).matches,
            0u);
}

TEST(Evaluation, AnOverlongPredictionMatches) {
  // 0.4 m beyond each end still match: the distance to the end sample is below 0.5 m.
  const evaluation::Score overlong =
      score({straight(0, 5, 15)}, {straight(0, 0, 25)}).of(evaluation::LineKind::laneline);
  EXPECT_EQ(overlong.matches, 1u);
  // 101 samples at distance 0; beyond each end 0.1 + 0.2 + 0.3 + 0.4 (0.5 is too far).
  EXPECT_NEAR(overlong.acd_m(), 2.0 / 109.0, 1e-9);
}

TEST(Evaluation, OnlyTheSameKindMatches) {
  const evaluation::MapScore swapped =
      score({straight(0, 0, 20)}, {straight(0, 0, 20, evaluation::LineKind::roadedge)});
  EXPECT_EQ(swapped.markings().matches, 0u);
  EXPECT_EQ(swapped.of(evaluation::LineKind::laneline).truths, 1u);
  EXPECT_EQ(swapped.of(evaluation::LineKind::roadedge).predictions, 1u);
}

TEST(Evaluation, ATruthLineIsMatchedOnce) {
  const evaluation::Score doubled = score({straight(0, 0, 20)}, {straight(0.3, 0, 20), straight(0.1, 0, 20)})
                                        .of(evaluation::LineKind::laneline);
  EXPECT_EQ(doubled.matches, 1u);
  EXPECT_DOUBLE_EQ(doubled.precision(), 0.5);
  EXPECT_DOUBLE_EQ(doubled.recall(), 1.0);
  EXPECT_NEAR(doubled.f1(), 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(doubled.acd_m(), 0.1, 1e-9);  // the nearer one, as both match all their samples
}

TEST(Evaluation, APredictionMatchesOnce) {
  const evaluation::Score joined = score({straight(0, 0, 9), straight(0, 10, 20)}, {straight(0, 0, 20)})
                                       .of(evaluation::LineKind::laneline);
  EXPECT_EQ(joined.matches, 1u);
  EXPECT_DOUBLE_EQ(joined.precision(), 1.0);
  EXPECT_DOUBLE_EQ(joined.recall(), 0.5);
}

TEST(Evaluation, SeesTheMapFromTheVehicle) {
  Eigen::Isometry3d T_map_body = Eigen::Isometry3d::Identity();
  T_map_body.translate(Point(1000.0, -500.0, 3.0))
      .rotate(Eigen::AngleAxisd(std::numbers::pi / 2, Point::UnitZ()));
  // Body x is map y: 6 m ahead of the rear end of the box are in it, all else is not.
  const std::vector<evaluation::KindLine> truth{
      {evaluation::LineKind::laneline, {{1000, -600, 3}, {1000, -499, 3}}},
      {evaluation::LineKind::laneline, {{1040, -500, 3}, {1080, -500, 3}}}};
  const evaluation::Score seen =
      score(truth, {{evaluation::LineKind::laneline, {{1000, -505, 3}, {1000, -499, 3}}}}, T_map_body)
          .of(evaluation::LineKind::laneline);
  EXPECT_EQ(seen.truths, 1u);
  EXPECT_EQ(seen.matches, 1u);
}

TEST(Evaluation, SumsOverFrames) {
  evaluation::MapScore sum;
  add(evaluation::compare({straight(0, 0, 20)}, {straight(0.2, 0, 20)}, Eigen::Isometry3d::Identity(),
                          kRange),
      sum);
  add(evaluation::compare({straight(0, 0, 20), straight(5, 0, 20)}, {straight(0.4, 0, 20)},
                          Eigen::Isometry3d::Identity(), kRange),
      sum);
  add(evaluation::compare({}, {straight(0, 0, 20)}, Eigen::Isometry3d::Identity(), kRange), sum);
  const evaluation::Score& lanelines = sum.of(evaluation::LineKind::laneline);
  EXPECT_EQ(sum.frames, 3u);
  EXPECT_DOUBLE_EQ(lanelines.precision(), 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(lanelines.recall(), 2.0 / 3.0);
  EXPECT_NEAR(lanelines.acd_m(), 0.3, 1e-9);
}

TEST(Evaluation, NothingAtAllIsZeroNotNan) {
  const evaluation::Score nothing = score({}, {}).of(evaluation::LineKind::laneline);
  EXPECT_EQ(nothing.precision(), 0.0);
  EXPECT_EQ(nothing.recall(), 0.0);
  EXPECT_EQ(nothing.f1(), 0.0);
  EXPECT_EQ(nothing.acd_m(), 0.0);
}

}  // namespace
}  // namespace laneloom
