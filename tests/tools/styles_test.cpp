#include "evaluation/styles.hpp"

#include <gtest/gtest.h>

namespace laneloom {
namespace {

evaluation::KindLine styled(double y, std::vector<StyleRange> styles,
                            evaluation::LineKind kind = evaluation::LineKind::laneline) {
  return {.kind = kind, .points = {{0, y, 0}, {20, y, 0}}, .styles = std::move(styles)};
}

evaluation::StyleScore score(const std::vector<evaluation::KindLine>& truth,
                             const std::vector<evaluation::KindLine>& lines) {
  evaluation::StyleScore result;
  const RangeConfig range;
  add_styles(compare(truth, lines, Eigen::Isometry3d::Identity(), range), truth, lines, result);
  return result;
}

const StyleRange kSolid{{0, 20}, MarkingStyle::solid};
const StyleRange kDashed{{0, 20}, MarkingStyle::dashed};

TEST(Styles, APerfectMapScoresPerfectly) {
  const std::vector<evaluation::KindLine> truth{styled(0, {kSolid}), styled(5, {kDashed})};
  EXPECT_EQ(score(truth, truth).right, 42u);
  EXPECT_EQ(score(truth, truth).accuracy(), 1.0);
  EXPECT_EQ(score(truth, truth).unknown_share(), 0.0);
}

TEST(Styles, CountEveryMetreByTheStyleThere) {
  // At 0, 1, …, 20 m: 11 solid, 5 dashed, 5 unknown.
  const evaluation::StyleScore mixed =
      score({styled(0, {kSolid})}, {styled(0.1, {{{0, 10.5}, MarkingStyle::solid},
                                                 {{10.5, 15.5}, MarkingStyle::dashed},
                                                 {{15.5, 20}, MarkingStyle::unknown}})});
  EXPECT_EQ(mixed.right, 11u);
  EXPECT_EQ(mixed.wrong, 5u);
  EXPECT_EQ(mixed.unknown, 5u);
  EXPECT_DOUBLE_EQ(mixed.accuracy(), 11.0 / 16.0);
  EXPECT_DOUBLE_EQ(mixed.unknown_share(), 5.0 / 21.0);
}

TEST(Styles, LeaveOutWhatCannotBeToldOrIsNoMatch) {
  const evaluation::StyleScore nothing =
      score({styled(0, {}), styled(5, {kSolid}, evaluation::LineKind::roadedge), styled(9, {kSolid})},
            {styled(0, {kSolid}), styled(5, {kSolid}, evaluation::LineKind::roadedge)});
  EXPECT_EQ(nothing.right + nothing.wrong + nothing.unknown, 0u);
}

}  // namespace
}  // namespace laneloom
