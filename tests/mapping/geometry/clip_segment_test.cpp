#include "mapping/geometry/clip_segment.hpp"

#include <gtest/gtest.h>

namespace laneloom {
namespace {

const Eigen::AlignedBox2d kBox(Eigen::Vector2d(0, 0), Eigen::Vector2d(10, 4));

std::optional<geometry::SegmentPart> clipped(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return geometry::clip_segment(a, b, kBox);
}

TEST(ClipSegment, GivesThePartInTheBoxAsShares) {
  const auto across = clipped({-10, 2}, {30, 2});
  ASSERT_TRUE(across);
  EXPECT_DOUBLE_EQ(across->from, 0.25);
  EXPECT_DOUBLE_EQ(across->to, 0.5);
  const auto within = clipped({9, 3}, {1, 1});
  ASSERT_TRUE(within);
  EXPECT_EQ(within->from, 0.0);
  EXPECT_EQ(within->to, 1.0);
}

TEST(ClipSegment, TheBorderIsInTheBox) {
  EXPECT_TRUE(clipped({1, 4}, {9, 4}));
  EXPECT_FALSE(clipped({1, 4.1}, {9, 4.1}));
}

TEST(ClipSegment, ASegmentThatOnlyTouchesIsOutside) {
  EXPECT_FALSE(clipped({10, 2}, {12, 2}));
  EXPECT_FALSE(clipped({8, 6}, {12, 2})) << "through a corner";
}

TEST(ClipSegment, HeightCountsWhereTheBoxHasOne) {
  const Eigen::AlignedBox3d box(Eigen::Vector3d(0, 0, -3), Eigen::Vector3d(10, 4, 3));
  EXPECT_TRUE(geometry::clip_segment(Eigen::Vector3d(1, 2, 0), Eigen::Vector3d(9, 2, 0), box));
  EXPECT_FALSE(geometry::clip_segment(Eigen::Vector3d(1, 2, 6), Eigen::Vector3d(9, 2, 6), box));
}

}  // namespace
}  // namespace laneloom
